//! What must stand before anything else runs: panics and log lines that can be seen.
use js_sys::Function;
use log::{Level, LevelFilter, Log, Metadata, Record};
use std::cell::RefCell;
use std::panic::PanicHookInfo;
use wasm_bindgen::prelude::*;
use web_sys::console;

thread_local! {
    static ON_PANIC: RefCell<Option<Function>> = const { RefCell::new(None) };
}

/// To be called once, first. `on_panic` hears the words of a panic: after one the module is
/// unusable, and calls under way never end.
#[wasm_bindgen]
pub fn start(on_panic: Function) {
    ON_PANIC.set(Some(on_panic));
    std::panic::set_hook(Box::new(tell));
    // A second start is a page that loads the module twice: the first logger stays.
    if log::set_logger(&Console).is_ok() {
        log::set_max_level(LevelFilter::Warn);
    }
}

fn tell(panic: &PanicHookInfo<'_>) {
    console_error_panic_hook::hook(panic);
    ON_PANIC.with_borrow(|listener| {
        if let Some(listener) = listener {
            // Nothing can be done about a listener that throws.
            let _ = listener.call1(&JsValue::NULL, &panic.to_string().into());
        }
    });
}

/// Shader errors are only logged by the GPU's runtime, and this is where they become visible.
struct Console;

impl Log for Console {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.level() <= Level::Warn
    }

    fn log(&self, record: &Record<'_>) {
        let line = format!("{}: {}", record.target(), record.args()).into();
        match record.level() {
            Level::Error => console::error_1(&line),
            Level::Warn => console::warn_1(&line),
            _ => {}
        }
    }

    fn flush(&self) {}
}
