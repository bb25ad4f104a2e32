//! Runs a loop over arrays with the widest vectors that this processor has.
//!
//! The same code is compiled twice, so that both give the same bits: Rust never fuses a product
//! and a sum unasked, and `contracted` and `kahan`, which ask, get the same fused operation either way. This is the one
//! place of the crate that needs `unsafe`.

/// A loop over arrays that is worth compiling for wider vectors.
pub trait Kernel {
    /// Runs it; `#[inline(always)]`, and so must be all that it calls.
    fn run(self);
}

/// Whether this processor has AVX2 and FMA.
pub fn is_wide() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("avx2")
        && std::arch::is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    false
}

/// Whether this processor fuses a product and a sum: all of a kind do, but those of x86.
pub fn has_fma() -> bool {
    if cfg!(target_arch = "x86_64") {
        is_wide()
    } else {
        cfg!(target_arch = "aarch64")
    }
}

/// Runs the kernel, with AVX2 and FMA where the processor has it.
pub fn dispatch(kernel: impl Kernel) {
    #[cfg(target_arch = "x86_64")]
    if is_wide() {
        #[expect(
            unsafe_code,
            reason = "calls code compiled for features that were just found"
        )]
        // SAFETY: the processor has AVX2 and FMA, which is all that `with_avx2` asks.
        unsafe {
            with_avx2(kernel);
        }
        return;
    }
    kernel.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn with_avx2(kernel: impl Kernel) {
    kernel.run();
}
