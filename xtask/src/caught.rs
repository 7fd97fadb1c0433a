//! Checks that must fail where something is broken on purpose.

/// `Ok` where a check has failed for one of these reasons.
pub fn caught<T>(found: Result<T, String>, reasons: &[&str]) -> Result<(), String> {
    match found {
        Err(why) if reasons.iter().any(|reason| why.contains(reason)) => Ok(()),
        Err(why) => Err(format!("refused for another reason: {why}")),
        Ok(_) => Err("not caught".to_owned()),
    }
}
