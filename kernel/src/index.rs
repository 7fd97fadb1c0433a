//! The two index types: `u16` (the microcontroller's) and `u32` (large meshes on the host).
//!
//! Narrowing is always checked: [`Index::new`] refuses what does not fit. Every index array is
//! validated once, by the constructor of the type that holds it; the loops behind it read through
//! [`read`], which has no panicking path, so that a kernel image holds no panic machinery.

mod sealed {
    pub trait Sealed {}
    impl Sealed for u16 {}
    impl Sealed for u32 {}
}

/// An index into vertices, cells or edges: `u16` or `u32`, and nothing else.
pub trait Index: Copy + Eq + Ord + Default + core::fmt::Debug + sealed::Sealed + 'static {
    /// Position 0.
    const FIRST: Self;
    /// "There is none": the second cell of a boundary edge.
    const NONE: Self;
    /// The largest number of things that this type can number.
    const LIMIT: usize;

    /// `None` where `position` does not fit.
    fn new(position: usize) -> Option<Self>;

    /// The position it stands for.
    fn at(self) -> usize;
}

macro_rules! index {
    ($integer:ident) => {
        impl Index for $integer {
            const FIRST: Self = 0;
            const NONE: Self = $integer::MAX;
            const LIMIT: usize = $integer::MAX as usize;

            fn new(position: usize) -> Option<Self> {
                if position < Self::LIMIT { Some(position as Self) } else { None }
            }

            fn at(self) -> usize {
                self as usize
            }
        }
    };
}

index!(u16);
index!(u32);

/// The entry at `position`, or the default where a (never validated) index points outside.
#[inline(always)]
pub fn read<T: Copy + Default>(slice: &[T], position: usize) -> T {
    match slice.get(position) {
        Some(&entry) => entry,
        None => T::default(),
    }
}

/// Sets the entry at `position`; nothing where a (never validated) index points outside.
#[inline(always)]
pub fn write<T>(slice: &mut [T], position: usize, entry: T) {
    if let Some(place) = slice.get_mut(position) {
        *place = entry;
    }
}
