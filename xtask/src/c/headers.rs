use crate::steps::Steps;
pub fn run(_: &mut Steps) {}
