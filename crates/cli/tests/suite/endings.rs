//! What a file holds, by its ending.

use crate::command::{Folder, run};

/// No table under another name: an ending is honoured, in capitals too, or refused before anything is computed.
#[test]
fn a_file_holds_what_its_ending_says() {
    let folder = Folder::new();
    for args in [
        "cost figure-4-r02 --seconds 0.1",
        "regimes --damping-ratio 0.1,1 --speed-ratio 1,2",
        "sample figure-4-r02 --quantity centre --times 1",
        "reference figure-4-r02 --times 1",
    ] {
        let run_to = |file: &str| run(&format!("{args} -o {file}"));
        let refused = run_to(&folder.path("x.xlsx"));
        assert_eq!(refused.code, Some(2), "{args}: {}", refused.out);
        assert!(refused.err.contains("xlsx"), "{}", refused.err);
        assert_eq!(run_to(&folder.path("x.CSV")).code, Some(0), "{args}");
        assert!(folder.read("x.CSV").contains(','), "{args}");
        std::fs::remove_file(folder.path("x.CSV")).unwrap();
        assert_eq!(folder.count(), 0);
    }
}

/// A pipe is written to; no file takes its place.
#[cfg(unix)]
#[test]
fn a_pipe_is_not_replaced() {
    let folder = Folder::new();
    let pipe = std::path::PathBuf::from(folder.path("pipe.csv"));
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let path = pipe.clone();
    let reader = std::thread::spawn(move || std::fs::read_to_string(path).unwrap());
    let found = run(&format!("reference figure-4-r02 --times 1 -o {}", pipe.to_str().unwrap()));
    assert_eq!(found.code, Some(0), "{}", found.err);
    assert!(reader.join().unwrap().contains("u_end"));
    assert!(!pipe.is_file() && pipe.exists());
}
