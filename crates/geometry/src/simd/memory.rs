//! A hint to the processor about memory: it changes how long things take, and nothing else.

/// Has the processor fetch the lines of the cache in which an item lies, while it goes on with other work. Nothing happens
/// where the index is out of range, or where no such instruction is known.
#[inline(always)]
pub(crate) fn prefetch<T>(items: &[T], index: usize) {
    #[cfg(target_arch = "x86_64")]
    if index < items.len() {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        const LINE: usize = 64;
        let start = items.as_ptr().wrapping_add(index).cast::<i8>();
        for line in 0..size_of::<T>().div_ceil(LINE) {
            #[expect(unsafe_code, reason = "no safe function has the instruction")]
            // SAFETY: whatever the address, the instruction reads nothing and cannot fault; every x86-64 processor has it.
            unsafe {
                _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(line * LINE));
            }
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (items, index);
}
