# farol_unity(target): its sources are compiled eight at a time where FAROL_UNITY is on.
function(farol_unity target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${FAROL_UNITY} UNITY_BUILD_BATCH_SIZE 8)
    if(FAROL_UNITY)
        # Sources are includes then: a type of a source may use another one of its anonymous namespace.
        target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    endif()
endfunction()

# farol_floor(name library... EXCEPT folder...): the static library farol_<name> of all sources below
# this folder, which links `library...`; new files are found by themselves. The folders after EXCEPT
# hold something else.
function(farol_floor name)
    cmake_parse_arguments(FLOOR "" "" "EXCEPT" ${ARGN})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    foreach(folder IN LISTS FLOOR_EXCEPT)
        list(FILTER sources EXCLUDE REGEX "/${name}/${folder}/")
    endforeach()
    add_library(farol_${name} STATIC ${sources})
    target_link_libraries(farol_${name} PUBLIC farol_options ${FLOOR_UNPARSED_ARGUMENTS})
    farol_unity(farol_${name})
endfunction()

# farol_without_unity(source...): sources of this folder that are compiled one at a time, as their
# names, or those of what they include, clash with others'.
function(farol_without_unity)
    set_property(SOURCE ${ARGN} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
