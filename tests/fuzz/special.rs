//! Files that are no files: nothing is read from a device, a folder, a pipe or a socket, wherever a scene names one.

use std::{fs, os::unix::net::UnixListener, path::Path, process::Command};

use raypacket::scene::load;

use crate::{folder, watch};

/// Names of files in the folder that are none.
fn special(folder: &Path) -> Vec<&'static str> {
    assert!(Command::new("mkfifo").arg(folder.join("pipe")).status().unwrap().success());
    // The socket's file stays when nobody listens any more.
    drop(UnixListener::bind(folder.join("socket")).unwrap());
    fs::create_dir(folder.join("directory")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", folder.join("link")).unwrap();
    vec!["pipe", "socket", "directory", "link", "/dev/zero", "/dev/full", "/dev/tty", "..", "."]
}

/// All that would wait for a pipe, or read zeros until no memory is left, does not return.
#[test]
fn only_regular_files_are_read() {
    let _alone = watch::alone();
    let folder = folder("special");
    let refused = |file: &str, what: &str| {
        let error = load(folder.join(file).to_str().unwrap()).expect_err(what).to_string();
        assert!(error.ends_with(": not a regular file"), "{what}: {error}");
    };
    for name in special(&folder) {
        let named = |file: &str, text: String| {
            fs::write(folder.join(file), &text).unwrap();
            refused(file, &text);
        };
        named("mesh.toml", format!("mesh = [{{ file = '{name}' }}]"));
        named("texture.toml", format!("materials.a.texture = '{name}'"));
        named("sky.toml", format!("sky.image = '{name}'"));
        named("library.obj", format!("mtllib {name}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
        fs::write(folder.join("a.mtl"), format!("newmtl a\nmap_Kd {name}\n")).unwrap();
        named("texture.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n".into());
    }
    for extension in ["toml", "nff", "obj"] {
        let file = format!("scene.{extension}");
        let _ = fs::remove_file(folder.join(&file));
        assert!(Command::new("mkfifo").arg(folder.join(&file)).status().unwrap().success());
        refused(&file, extension);
        fs::remove_file(folder.join(&file)).unwrap();
        std::os::unix::fs::symlink("/dev/zero", folder.join(&file)).unwrap();
        refused(&file, extension);
    }
}
