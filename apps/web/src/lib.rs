//! durer as a WebAssembly module: files come in as bytes, pictures or messages go out as bytes.
//!
//! The interface is a handful of functions over numbers, so that no tool is needed but the compiler. JavaScript asks for
//! room with [`input`], writes there, and calls one of the others; what comes of it lies at [`output`]. One instance works
//! for one caller: nothing waits, and there are no threads. `reproduce.mjs` shows how it is used.

mod desk;

use desk::with_desk;

/// Makes room for so many bytes of input; gives where they are to be written.
#[expect(unsafe_code, reason = "JavaScript finds functions by their names")]
// SAFETY: no other function of the module has this name.
#[unsafe(no_mangle)]
pub extern "C" fn input(length: usize) -> *mut u8 {
    with_desk(|desk| desk.room(length).as_mut_ptr())
}

/// Adds a file for scenes to name, or for [`fingerprint`]: the first `name_length` bytes of the input are its name, relative
/// to the scene, the rest its content.
#[expect(unsafe_code, reason = "JavaScript finds functions by their names")]
// SAFETY: no other function of the module has this name.
#[unsafe(no_mangle)]
pub extern "C" fn add_file(name_length: usize) {
    with_desk(|desk| desk.add_file(name_length));
}

/// Renders the scene file whose name is the input, with a longer side of so many pixels. The output is the fingerprint of
/// the film in hexadecimal digits, or, if this gives 0, a message.
#[expect(unsafe_code, reason = "JavaScript finds functions by their names")]
// SAFETY: no other function of the module has this name.
#[unsafe(no_mangle)]
pub extern "C" fn fingerprint(longer_side: u32) -> u32 {
    with_desk(|desk| u32::from(desk.fingerprint(longer_side)))
}

/// Where the output of the last call lies.
#[expect(unsafe_code, reason = "JavaScript finds functions by their names")]
// SAFETY: no other function of the module has this name.
#[unsafe(no_mangle)]
pub extern "C" fn output() -> *const u8 {
    with_desk(|desk| desk.output().as_ptr())
}

/// How many bytes of output there are.
#[expect(unsafe_code, reason = "JavaScript finds functions by their names")]
// SAFETY: no other function of the module has this name.
#[unsafe(no_mangle)]
pub extern "C" fn output_length() -> usize {
    with_desk(|desk| desk.output().len())
}
