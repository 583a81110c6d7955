# Writes man pages and completions: cmake -DFAROL=program -DOUT=folder -P cmake/manual.cmake
file(MAKE_DIRECTORY ${OUT}/man1)

function(write file)
    execute_process(COMMAND ${FAROL} ${ARGN} OUTPUT_FILE ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(compress file)
    execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

execute_process(COMMAND ${FAROL} man --list OUTPUT_VARIABLE commands COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "\n$" "" commands "${commands}")
string(REPLACE "\n" ";" commands "${commands}")
write(${OUT}/man1/farol.1 man)
compress(${OUT}/man1/farol.1)
foreach(command IN LISTS commands)
    write(${OUT}/man1/farol-${command}.1 man ${command})
    compress(${OUT}/man1/farol-${command}.1)
endforeach()
foreach(shell bash zsh fish)
    write(${OUT}/farol.${shell} completion ${shell})
endforeach()
