# farol_embed(target name file...): makes `std::span<const farol::EmbeddedFile> farol::name()` in
# the target, holding the files' bytes and base names. Declare it with "core/embedded.h".
# Run as a script (-DOUT= -DNAME= -DFOLDER=) it does the same for all files below a folder, under
# their paths in it: for files whose names are known only when they are built.

# The assembler reads the files itself: no megabytes of hexadecimal to compile.
function(farol_embed_source out name) # NAME_IN_PROGRAM FILE ...
    set(body "#include \"core/embedded.h\"\n#include <span>\nnamespace farol {\nnamespace {\n")
    set(table "")
    set(index 0)
    set(rest ${ARGN})
    while(rest)
        list(POP_FRONT rest path file)
        string(APPEND body "extern \"C\" const char ${name}_${index}_begin[], ${name}_${index}_end[];\n"
            "__asm__(\".section .rodata\\n.global ${name}_${index}_begin\\n.global ${name}_${index}_end\\n\"\n"
            "        \"${name}_${index}_begin:\\n.incbin \\\"${file}\\\"\\n${name}_${index}_end:\\n.byte 0\\n.previous\\n\");\n")
        string(APPEND table "        {\"${path}\", std::string_view(${name}_${index}_begin, static_cast<std::size_t>(${name}_${index}_end - ${name}_${index}_begin))},\n")
        math(EXPR index "${index} + 1")
    endwhile()
    string(APPEND body "}\nstd::span<const EmbeddedFile> ${name}() {\n    static const EmbeddedFile files[] = {\n${table}    };\n    return files;\n}\n}\n")
    file(CONFIGURE OUTPUT ${out} CONTENT "${body}" @ONLY)
endfunction()

function(farol_embed target name)
    set(out ${CMAKE_BINARY_DIR}/embedded_${name}.cpp)
    set(pairs "")
    foreach(file ${ARGN})
        get_filename_component(base ${file} NAME)
        list(APPEND pairs ${base} ${file})
    endforeach()
    farol_embed_source(${out} ${name} ${pairs})
    # On its own: a unity source has no OBJECT_DEPENDS, and a changed file would not be built in.
    set_source_files_properties(${out} PROPERTIES OBJECT_DEPENDS "${ARGN}"
                                                  SKIP_UNITY_BUILD_INCLUSION ON)
    target_sources(${target} PRIVATE ${out})
endfunction()

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
    file(GLOB_RECURSE paths RELATIVE ${FOLDER} ${FOLDER}/*)
    set(pairs "")
    foreach(path ${paths})
        list(APPEND pairs ${path} ${FOLDER}/${path})
    endforeach()
    file(REMOVE ${OUT}) # a new time stamp even where only the contents of the files changed
    farol_embed_source(${OUT} ${NAME} ${pairs})
endif()
