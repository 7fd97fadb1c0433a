//! Whose cost decides. (A stand-in until the measurement on boards is here.)

/// Host or board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// This machine.
    Host,
    /// A Cortex-M4F.
    M4f,
    /// A Cortex-M7.
    M7,
}
