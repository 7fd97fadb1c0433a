//! A solution as text: what a scene file says of it.

/// u, ∇u and f as expressions.
#[derive(Debug, Clone, PartialEq)]
pub struct Texts {
    /// u
    pub u: String,
    /// ∂u/∂x, ∂u/∂y
    pub gradient: [String; 2],
    /// −∇·(A∇u)
    pub f: String,
}

impl Texts {
    /// −u
    pub(super) fn negated(self) -> Self {
        let negative = |text: String| format!("-({text})");
        Self { u: negative(self.u), gradient: self.gradient.map(negative), f: negative(self.f) }
    }
}
