#![no_std]
//! Kernel.
