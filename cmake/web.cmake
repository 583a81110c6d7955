# Builds the web page for the program to embed: ${CMAKE_BINARY_DIR}/page holds the files afterwards.
# The plain page is always among them; the other one is where npm is, and what it needs can be had.
# All builds share one copy of the packages and of the result, in build/web:
#   node_modules   by `npm ci`, again only when the lock file has changed
#   stage          the sources, in the layout they have in the project
# Included, it defines farol_web(target); run as a script it does the work, at build time.

function(farol_web target)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/web/*)
    list(FILTER sources EXCLUDE REGEX "/web/(node_modules|dist)/")
    list(APPEND sources ${CMAKE_SOURCE_DIR}/api/openapi.yaml ${CMAKE_SOURCE_DIR}/api/scene.xsd
         ${CMAKE_SOURCE_DIR}/api/errors.md ${CMAKE_SOURCE_DIR}/docs/scene-language.md)
    set(out ${CMAKE_BINARY_DIR}/embedded_webFiles.cpp)
    add_custom_command(OUTPUT ${out}
        COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR} -DPAGE=${CMAKE_BINARY_DIR}/page
                -P ${CMAKE_SOURCE_DIR}/cmake/web.cmake
        COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DNAME=webFiles -DFOLDER=${CMAKE_BINARY_DIR}/page
                -P ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
        DEPENDS ${sources} ${CMAKE_SOURCE_DIR}/cmake/web.cmake ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
        COMMENT "Building the web page" VERBATIM)
    target_sources(${target} PRIVATE ${out})
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
    return()
endif()

# Runs a command; leaves the reason in ${failed} where it does not succeed.
function(run what folder)
    execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${folder} RESULT_VARIABLE code
                    OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT code EQUAL 0)
        set(failed "${what} failed: ${output}" PARENT_SCOPE)
    endif()
endfunction()

function(build_page)
    set(shared ${SOURCE}/build/web)
    set(stage ${shared}/stage)
    set(failed "")
    find_program(NPM npm)
    find_program(NODE NAMES node nodejs)
    if(NOT NPM OR NOT NODE)
        set(problem "there is no node or npm" PARENT_SCOPE)
        return()
    endif()
    file(MAKE_DIRECTORY ${shared})
    file(LOCK ${shared}/lock GUARD FUNCTION TIMEOUT 600)

    file(SHA256 ${SOURCE}/web/package-lock.json lock)
    set(stamp "")
    if(EXISTS ${shared}/packages.stamp)
        file(READ ${shared}/packages.stamp stamp)
    endif()
    if(NOT stamp STREQUAL lock)
        file(REMOVE ${shared}/packages.stamp)
        file(COPY ${SOURCE}/web/package.json ${SOURCE}/web/package-lock.json DESTINATION ${shared})
        run("npm ci" ${shared} ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error)
        if(failed)
            set(problem "${failed}" PARENT_SCOPE)
            return()
        endif()
        file(WRITE ${shared}/packages.stamp ${lock})
    endif()

    file(REMOVE_RECURSE ${stage})
    file(COPY ${SOURCE}/web DESTINATION ${stage} PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE)
    file(COPY ${SOURCE}/api/scene.xsd ${SOURCE}/api/errors.md DESTINATION ${stage}/api)
    file(COPY ${SOURCE}/docs/scene-language.md DESTINATION ${stage}/docs)
    run("esbuild" ${stage}/web ${NODE} build.mjs)
    if(failed)
        # The packages are there, so this is a fault of the sources: no page in its place.
        message(FATAL_ERROR "The web page cannot be built: ${failed}")
    endif()
    file(COPY ${stage}/web/dist/ DESTINATION ${PAGE})
endfunction()

file(REMOVE_RECURSE ${PAGE})
file(MAKE_DIRECTORY ${PAGE}/assets)
file(COPY ${SOURCE}/web/plain/plain.html ${SOURCE}/api/openapi.yaml DESTINATION ${PAGE})
file(COPY ${SOURCE}/web/plain/plain.js ${SOURCE}/web/plain/plain.css DESTINATION ${PAGE}/assets)
set(problem "")
build_page()
if(problem)
    message("The plain web page is served, because ${problem}")
endif()
