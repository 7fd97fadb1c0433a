//! Commands that run at the same time and would use the same files take turns.

use std::fs::{File, TryLockError};
use std::path::Path;

use crate::files;

/// Waits until no other holder of the lock file `path` is left; it is free again when what is returned is dropped, or when
/// this process ends, however that happens. Where a file system has no locks, nobody waits.
///
/// # Errors
/// A file that cannot be made.
pub fn hold(path: &Path) -> Result<File, String> {
    files::folder(path.parent().unwrap_or(Path::new(".")))?;
    let file = files::named(path, File::options().create(true).append(true).open(path))?;
    if let Err(TryLockError::WouldBlock) = file.try_lock() {
        eprintln!("waiting for another command that uses {}", path.display());
        files::named(path, file.lock())?;
    }
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::sync::Mutex;
    use std::thread;
    use std::time::Duration;

    #[test]
    fn who_comes_second_waits() {
        let path = std::env::temp_dir().join(format!("xtask-lock-{}/a.lock", std::process::id()));
        let order = Mutex::new(Vec::new());
        let say = |what| order.lock().unwrap().push(what);
        thread::scope(|scope| {
            let first = hold(&path).unwrap();
            let second = scope.spawn(|| {
                let _held = hold(&path).unwrap();
                say("second");
            });
            thread::sleep(Duration::from_millis(50));
            say("first");
            drop(first);
            second.join().unwrap();
        });
        assert_eq!(*order.lock().unwrap(), ["first", "second"]);
        // Another file is nobody's business.
        let other = path.with_file_name("b.lock");
        let (_one, _two) = (hold(&path).unwrap(), hold(&other).unwrap());
        fs::remove_dir_all(path.parent().unwrap()).unwrap();
    }
}
