//! The demo's server: the built page, to this computer only.

use std::fs::File;
use std::io::ErrorKind;
use std::net::{Ipv4Addr, TcpListener};
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use percent_encoding::percent_decode_str;
use tiny_http::{Header, Method, Request, Response, Server};

use crate::run;

/// Browsers ask for several files at once.
const WORKERS: usize = 4;

/// Serves a folder until the program is stopped.
pub fn serve(folder: &Path, port: u16) -> Result<()> {
    if !folder.join("index.html").is_file() {
        bail!("{} holds no page", folder.display());
    }
    let listener = bind(port)?;
    let address = listener.local_addr().context("the server has no address")?;
    let server = Server::from_listener(listener, None)
        .map_err(|error| anyhow!("the server does not start: {error}"))?;
    run::note(&format!(
        "Normalight is at http://{address}/ (Ctrl-C stops it)"
    ));
    std::thread::scope(|scope| {
        for _ in 0..WORKERS {
            scope.spawn(|| {
                for request in server.incoming_requests() {
                    // A browser that went away in the middle is no error.
                    let _ = answer(request, folder);
                }
            });
        }
    });
    Ok(())
}

/// Listens on the port, or on the first free one after it.
fn bind(port: u16) -> Result<TcpListener> {
    for candidate in port..=u16::MAX {
        match TcpListener::bind((Ipv4Addr::LOCALHOST, candidate)) {
            Err(error) if error.kind() == ErrorKind::AddrInUse => {}
            result => return result.with_context(|| format!("cannot serve on port {candidate}")),
        }
    }
    bail!("no port from {port} on is free")
}

fn answer(request: Request, folder: &Path) -> std::io::Result<()> {
    if !matches!(request.method(), Method::Get | Method::Head) {
        return request.respond(Response::empty(405));
    }
    let file = inside(folder, request.url()).and_then(|path| Some((File::open(&path).ok()?, path)));
    let Some((file, path)) = file else {
        return request.respond(Response::from_string("not found").with_status_code(404));
    };
    let kind = mime_guess::from_path(&path).first_or_octet_stream();
    let mut response = Response::from_file(file)
        // Whole, with its length: the page shows how far the weights are.
        .with_chunked_threshold(usize::MAX);
    // A new build is seen at the next reload.
    for (name, value) in [
        ("Content-Type", kind.essence_str()),
        ("Cache-Control", "no-cache"),
    ] {
        if let Ok(header) = Header::from_bytes(name, value) {
            response.add_header(header);
        }
    }
    request.respond(response)
}

/// The file an address names, if it lies inside the folder.
fn inside(folder: &Path, address: &str) -> Option<PathBuf> {
    let name = address.split(['?', '#']).next()?.trim_start_matches('/');
    let name = percent_decode_str(name).decode_utf8().ok()?;
    let name = Path::new(name.as_ref());
    if name
        .components()
        .any(|part| !matches!(part, Component::Normal(_)))
    {
        return None;
    }
    let mut path = folder.join(name);
    if path.is_dir() {
        path.push("index.html");
    }
    path.is_file().then_some(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_stay_inside_the_folder() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        assert_eq!(
            inside(folder, "/src/main.rs?v=1"),
            Some(folder.join("src/main.rs"))
        );
        assert_eq!(
            inside(folder, "/src%2Fmain.rs"),
            Some(folder.join("src/main.rs"))
        );
        for outside in [
            "/../Cargo.toml",
            "/%2e%2e/Cargo.toml",
            "//etc/passwd",
            "/src",
            "/none",
        ] {
            assert_eq!(inside(folder, outside), None, "{outside}");
        }
    }

    #[test]
    fn a_taken_port_is_passed_over() {
        let first = bind(40_000).unwrap().local_addr().unwrap().port();
        let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, first)).unwrap();
        let next = bind(first).unwrap().local_addr().unwrap().port();
        assert!(next > first);
        drop(taken);
    }

    #[test]
    fn modules_are_served_as_such() {
        assert_eq!(
            mime_guess::from_path("a.wasm").first_or_octet_stream(),
            "application/wasm"
        );
        assert_eq!(
            mime_guess::from_path("a.js").first_or_octet_stream(),
            "text/javascript"
        );
    }
}
