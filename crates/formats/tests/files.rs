//! Files on disk: images beside the scene are read, others are refused.

use durer_formats::{LoadOptions, Loaded, load_file};
use std::path::Path;

const PICTURE: &[u8] = b"PF\n1 1\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0";

fn load(folder: &Path, image: &str, options: &LoadOptions) -> Result<Loaded, String> {
    let scene = folder.join("scene.yaml");
    std::fs::write(&scene, format!("textures:\n  a: {{image: {{file: \"{image}\"}}}}\n")).unwrap();
    load_file(&scene, options).map_err(|diagnostics| diagnostics.to_string())
}

#[test]
fn images_come_from_the_scenes_folder_only() {
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("scene");
    std::fs::create_dir_all(folder.join("images")).unwrap();
    std::fs::write(outer.path().join("secret.pfm"), PICTURE).unwrap();
    std::fs::write(folder.join("images/good.pfm"), PICTURE).unwrap();
    std::fs::write(folder.join("bad.png"), b"not a picture").unwrap();
    let strict = LoadOptions::default();

    assert_eq!(load(&folder, "images/good.pfm", &strict).unwrap().scene.scene().images.len(), 1);
    assert!(load(&folder, "images/../images/good.pfm", &strict).is_ok());
    let absolute = outer.path().join("secret.pfm");
    for outside in ["../secret.pfm", "../missing.pfm", absolute.to_str().unwrap(), "/etc/passwd"] {
        let message = load(&folder, outside, &strict).unwrap_err();
        assert!(message.contains("outside the scene's folder") && message.contains("--allow-path"), "{message}");
    }
    assert!(load(&folder, "missing.png", &strict).unwrap_err().contains("there is no such file"));
    assert!(load(&folder, "images", &strict).unwrap_err().contains("this is not a file"));
    assert!(load(&folder, "bad.png", &strict).unwrap_err().contains("cannot use the image"));

    let generous = LoadOptions { allowed_folders: vec![outer.path().to_owned()], ..LoadOptions::default() };
    assert!(load(&folder, "../secret.pfm", &generous).is_ok());
}

#[cfg(unix)]
#[test]
fn links_that_lead_out_are_refused() {
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("scene");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(outer.path().join("secret.pfm"), PICTURE).unwrap();
    std::os::unix::fs::symlink("../secret.pfm", folder.join("link.pfm")).unwrap();
    assert!(load(&folder, "link.pfm", &LoadOptions::default()).unwrap_err().contains("outside"));
}

/// Folders that lead out, and what is no file: a pipe would be waited for without end, a device read without end.
#[cfg(unix)]
#[test]
fn links_pipes_and_devices_are_refused() {
    use std::os::unix::fs::symlink;
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("scene");
    std::fs::create_dir(&folder).unwrap();
    std::fs::create_dir(outer.path().join("secrets")).unwrap();
    std::fs::write(outer.path().join("secrets/a.pfm"), PICTURE).unwrap();
    std::fs::write(folder.join("good.pfm"), PICTURE).unwrap();
    symlink("../secrets", folder.join("folder")).unwrap();
    symlink("good.pfm", folder.join("inside.pfm")).unwrap();
    symlink("/dev/zero", folder.join("zero.pfm")).unwrap();
    symlink("loop.pfm", folder.join("loop.pfm")).unwrap();
    assert!(std::process::Command::new("mkfifo").arg(folder.join("pipe.pfm")).status().unwrap().success());
    let refused = |image: &str, why: &str| {
        let message = load(&folder, image, &LoadOptions::default()).unwrap_err();
        assert!(message.contains(why), "{image}: {message}");
    };
    assert!(load(&folder, "inside.pfm", &LoadOptions::default()).is_ok());
    refused("folder/a.pfm", "outside the scene's folder");
    refused("folder/missing.pfm", "cannot read");
    refused("folder/../secrets/a.pfm", "outside the scene's folder");
    refused("zero.pfm", "outside the scene's folder");
    refused("loop.pfm", "cannot read");
    refused("pipe.pfm", "this is not a file");
    refused("good.pfm/", "cannot read");
    refused("good.pfm/../../secrets/a.pfm", "outside the scene's folder");
    refused("..\\\\secrets\\\\a.pfm", "no such file");
    refused("%2e%2e/secrets/a.pfm", "no such file");
    refused("a\\0b.pfm", "cannot read");
    std::fs::rename(folder.join("pipe.pfm"), folder.join("pipe.yaml")).unwrap();
    let message = load_file(folder.join("pipe.yaml"), &LoadOptions::default()).unwrap_err().to_string();
    assert!(message.contains("not a file"), "{message}");
}

#[test]
fn a_missing_scene_is_said_so() {
    let message = load_file("no/such/scene.yaml", &LoadOptions::default()).unwrap_err().to_string();
    assert!(message.contains("cannot read this file"), "{message}");
}
