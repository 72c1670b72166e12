//! Machines without a display.

/// Begins the process anew with a quiet search for GPUs, where one would print errors that are none.
///
/// A layer of Mesa's Vulkan drivers asks the display server which GPU is in use, and on a machine without a display each
/// probe prints `error: XDG_RUNTIME_DIR is invalid or not set` above our own words. The layer can be switched off by a
/// variable of the environment, which must be there before the process has threads; nothing else changes, the process keeps
/// its number.
#[cfg(target_os = "linux")]
pub(crate) fn quiet_without() {
    use std::os::unix::process::CommandExt;
    use std::process::Command;

    const SWITCH: &str = "NODEVICE_SELECT";
    // Whoever chooses a GPU by the layer needs it.
    let said = [
        "XDG_RUNTIME_DIR",
        "WAYLAND_DISPLAY",
        "MESA_VK_DEVICE_SELECT",
        SWITCH,
    ];
    if said.iter().any(|name| std::env::var_os(name).is_some()) {
        return;
    }
    let mut arguments = std::env::args_os();
    if let (Some(name), Ok(program)) = (arguments.next(), std::env::current_exe()) {
        // Comes back only when it cannot be done: then the search is not quiet.
        let _ = Command::new(program)
            .arg0(name)
            .args(arguments)
            .env(SWITCH, "1")
            .exec();
    }
}

/// Other systems have nothing to say.
#[cfg(not(target_os = "linux"))]
pub(crate) fn quiet_without() {}
