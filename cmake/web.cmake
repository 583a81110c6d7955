# Gathers the web page for the program to embed: ${CMAKE_BINARY_DIR}/page holds the files afterwards.
#   web/page         the bundle, built by scripts/page
#   web/plain        the plain page
#   document.*.js    texts of the project that the bundle reads, each as a module
# Files that gain by it have a gzipped copy beside them, which the service sends to clients that accept it.
# Included, it defines farol_web(target); run as a script it does the work, at build time.

function(farol_web target)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/web/page/* ${CMAKE_SOURCE_DIR}/web/plain/*)
    list(APPEND sources ${CMAKE_SOURCE_DIR}/api/openapi.yaml ${CMAKE_SOURCE_DIR}/api/schema.json
         ${CMAKE_SOURCE_DIR}/api/errors.md)
    set(out ${CMAKE_BINARY_DIR}/embedded_webFiles.cpp)
    add_custom_command(OUTPUT ${out}
        COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR} -DPAGE=${CMAKE_BINARY_DIR}/page
                -P ${CMAKE_SOURCE_DIR}/cmake/web.cmake
        COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DNAME=webFiles -DFOLDER=${CMAKE_BINARY_DIR}/page
                -P ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
        DEPENDS ${sources} ${CMAKE_SOURCE_DIR}/cmake/web.cmake ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
        COMMENT "Gathering the web page" VERBATIM)
    target_sources(${target} PRIVATE ${out})
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
    return()
endif()

# Writes a text as a module whose default export it is.
function(write_document name file)
    file(READ ${SOURCE}/${file} text)
    string(REPLACE "\\" "\\\\" text "${text}")
    string(REPLACE "`" "\\`" text "${text}")
    string(REPLACE "\${" "\\\${" text "${text}")
    file(WRITE ${PAGE}/assets/document.${name}.js "export default `${text}`;\n")
endfunction()

file(REMOVE_RECURSE ${PAGE})
file(COPY ${SOURCE}/web/page/ DESTINATION ${PAGE})
file(COPY ${SOURCE}/web/plain/plain.html ${SOURCE}/api/openapi.yaml DESTINATION ${PAGE})
file(COPY ${SOURCE}/web/plain/plain.js ${SOURCE}/web/plain/plain.css DESTINATION ${PAGE}/assets)
write_document(errors api/errors.md)
write_document(schema api/schema.json)

find_program(GZIP gzip REQUIRED)
file(GLOB files ${PAGE}/assets/* ${PAGE}/index.html ${PAGE}/embed.html)
foreach(file ${files})
    execute_process(COMMAND ${GZIP} -9 -n -k ${file} COMMAND_ERROR_IS_FATAL ANY)
    file(SIZE ${file} plain)
    file(SIZE ${file}.gz packed)
    math(EXPR least "${plain} * 9 / 10")
    if(packed GREATER_EQUAL least)
        file(REMOVE ${file}.gz)
    endif()
endforeach()
