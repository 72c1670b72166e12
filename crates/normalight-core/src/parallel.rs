//! Work on all cores.

/// What `work` makes of each number below `count`, in order: on all cores where there are threads, one after the other
/// where there are none, as in the browser. The results are the same.
pub fn on_all_cores<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    #[cfg(not(target_arch = "wasm32"))]
    {
        use rayon::prelude::*;
        (0..count).into_par_iter().map(work).collect()
    }
    #[cfg(target_arch = "wasm32")]
    {
        (0..count).map(work).collect()
    }
}
