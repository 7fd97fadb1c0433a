# A controller in a program for the desk.
#
#   cmake -S . -B build && cmake --build build --target run
cmake_minimum_required(VERSION 3.16)
project(@name@_example C)

find_package(@name@ CONFIG REQUIRED PATHS "${CMAKE_CURRENT_SOURCE_DIR}/.." NO_DEFAULT_PATH)

add_executable(firmware main.c board.c)
target_link_libraries(firmware PRIVATE @name@::@name@)
set_target_properties(firmware PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
target_compile_options(firmware PRIVATE -O2 -Wall -Wextra -Wpedantic -Werror)
add_custom_target(run COMMAND firmware VERBATIM USES_TERMINAL)
