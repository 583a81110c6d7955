# farol_embed(target name file...): makes `std::span<const farol::EmbeddedFile> farol::name()` in
# the target, holding the files' bytes and base names. Declare it with "scene/embedded.h".
function(farol_embed target name)
    set(out ${CMAKE_BINARY_DIR}/embedded_${name}.cpp)
    set(body "#include \"scene/embedded.h\"\n#include <span>\nnamespace farol {\nnamespace {\n")
    set(table "")
    set(index 0)
    foreach(file ${ARGN})
        get_filename_component(base ${file} NAME)
        # The assembler reads the file itself: no megabytes of hexadecimal to compile.
        string(APPEND body "extern \"C\" const char ${name}_${index}_begin[], ${name}_${index}_end[];\n"
            "__asm__(\".section .rodata\\n.global ${name}_${index}_begin\\n.global ${name}_${index}_end\\n\"\n"
            "        \"${name}_${index}_begin:\\n.incbin \\\"${file}\\\"\\n${name}_${index}_end:\\n.byte 0\\n.previous\\n\");\n")
        string(APPEND table "        {\"${base}\", std::string_view(${name}_${index}_begin, static_cast<std::size_t>(${name}_${index}_end - ${name}_${index}_begin))},\n")
        math(EXPR index "${index} + 1")
    endforeach()
    string(APPEND body "}\nstd::span<const EmbeddedFile> ${name}() {\n    static const EmbeddedFile files[] = {\n${table}    };\n    return files;\n}\n}\n")
    file(CONFIGURE OUTPUT ${out} CONTENT "${body}" @ONLY)
    set_source_files_properties(${out} PROPERTIES OBJECT_DEPENDS "${ARGN}")
    target_sources(${target} PRIVATE ${out})
endfunction()
