//! An allocator that a dependency might bring, and something that calls it.

use alloc::boxed::Box;
use core::alloc::{GlobalAlloc, Layout};

struct Exhausted;

// SAFETY: a null pointer is how an allocator says that nothing is left.
unsafe impl GlobalAlloc for Exhausted {
    unsafe fn alloc(&self, _: Layout) -> *mut u8 {
        core::ptr::null_mut()
    }

    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}

#[global_allocator]
static ALLOCATOR: Exhausted = Exhausted;

/// A number on the heap.
#[unsafe(no_mangle)]
pub extern "C" fn boxed(number: u32) -> *mut u32 {
    Box::into_raw(Box::new(number))
}
