//! Verbs with words and a help of their own.

use std::process::ExitCode;

use crate::baked::Failure;

/// Reads the words after the verb and does what they say. The status is 2 where they are wrong, or what they name is.
pub fn command<'a, O>(
    words: &'a [&'a str],
    help: &str,
    parse: impl FnOnce(&'a [&'a str]) -> Result<O, String>,
    work: impl FnOnce(O) -> Result<(), Failure>,
) -> ExitCode {
    if words.iter().any(|word| ["--help", "-h"].contains(word)) {
        print!("{help}");
        return ExitCode::SUCCESS;
    }
    match parse(words).map(work) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        // What the bake said of wrong input stands above.
        Ok(Err(Failure { status: 2, .. })) => ExitCode::from(2),
        Ok(Err(Failure { why, status })) => {
            eprintln!("error: {why}");
            ExitCode::from(status)
        }
        Err(why) => {
            eprintln!("error: {why}\n\n{help}");
            ExitCode::from(2)
        }
    }
}
