//! The command normalight.
