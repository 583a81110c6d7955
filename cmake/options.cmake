# What every source is compiled with.
add_library(farol_options INTERFACE)
target_include_directories(farol_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_definitions(farol_options INTERFACE FAROL_VERSION="${PROJECT_VERSION}")
target_compile_options(farol_options INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wold-style-cast
    -Woverloaded-virtual -Wduplicated-cond -Wlogical-op
    # g++ 12 warns wrongly inside std::string (GCC bug 105651).
    -Wno-restrict
    # g++ 14 warns wrongly of alternatives that a std::variant does not hold; g++ 12 is the judge here.
    $<$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>:-Wno-maybe-uninitialized>
    # The same bytes on every machine: no fused multiply-add, which rounds once instead of twice.
    -ffp-contract=off)
if(FAROL_WERROR)
    target_compile_options(farol_options INTERFACE -Werror)
endif()

# farol_uses_regex(target): its sources or the headers of its libraries use std::regex, of which g++ 12
# takes members for uninitialised under sanitizers (GCC bug 105562): a warning there, no error.
function(farol_uses_regex target)
    target_compile_options(${target} PRIVATE
        $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-error=maybe-uninitialized>)
endfunction()
