//! A controller for C: its header, its library, what CMake reads of it, and an example around it.
//!
//! ```text
//!   Problem, Emitted ─► names, header ─┐
//!                     signorini_image::library ─► Files
//!                     config, example ─┘
//! ```
//! The header states what the library has: inputs and outputs from [`ModuleApi`], numbers and words from the kernel's
//! [`signorini_device::codes`], sizes from the library that was built.

mod comment;
mod example;
mod header;
mod names;
mod words;

pub use names::name_of;

use crate::emit::Emitted;
use crate::module_api::ModuleApi;
use signorini_image::library::{Library, Machine};
use signorini_problem::Problem;

/// A file: where it goes in the folder, and what is in it.
#[derive(Debug, Clone, PartialEq)]
pub struct File {
    /// Its path within the folder.
    pub path: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

impl File {
    fn text(path: impl Into<String>, text: String) -> Self {
        Self { path: path.into(), bytes: text.into_bytes() }
    }
}

/// All files of a controller for C. They belong together.
///
/// # Errors
/// The library cannot be built: what is missing.
pub fn files(problem: &Problem, emitted: &Emitted, on: &Machine) -> Result<Vec<File>, String> {
    let name = name_of(problem);
    let library = Library::build(&emitted.source, &emitted.chosen.kernel_features, &name, on)?;
    let api = ModuleApi::new(problem);
    let header =
        header::Header { name: &name, api: &api, chosen: &emitted.chosen, library: &library, on };
    let mut files = vec![
        File::text(format!("{name}.h"), header.text()),
        File::text(format!("{name}Config.cmake"), config(&name, on)),
    ];
    files.extend(
        example::files(&name, &api, on).into_iter().map(|(path, text)| File::text(path, text)),
    );
    // Last, since it is what a build waits for.
    files.push(File { path: format!("lib{name}.a"), bytes: library.archive });
    Ok(files)
}

/// The text of `NAMEConfig.cmake`, which `find_package` of CMake reads.
fn config(name: &str, on: &Machine) -> String {
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
