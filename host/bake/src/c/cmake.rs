//! What `find_package` of CMake reads.

use signorini_image::library::Machine;

/// The text of `NAMEConfig.cmake`.
pub fn text(name: &str, on: &Machine) -> String {
    let flags = on.flags.join(" ");
    format!(
        "# The controller {name}, built for {}. Written by signorini bake {}; do not edit.
#
#   list(APPEND CMAKE_PREFIX_PATH this/folder)
#   find_package({name} CONFIG REQUIRED)
#   target_link_libraries(firmware PRIVATE {name}::{name})

# What the library was built for; the header refuses other processors.
set({name}_COMPILE_OPTIONS \"{}\")

if(NOT TARGET {name}::{name})
  add_library({name}::{name} STATIC IMPORTED)
  set_target_properties({name}::{name} PROPERTIES
    IMPORTED_LOCATION \"${{CMAKE_CURRENT_LIST_DIR}}/lib{name}.a\"
    IMPORTED_LINK_INTERFACE_LANGUAGES C
    INTERFACE_INCLUDE_DIRECTORIES \"${{CMAKE_CURRENT_LIST_DIR}}\")
endif()
",
        on.word,
        env!("CARGO_PKG_VERSION"),
        flags.replace(' ', ";"),
    )
}
