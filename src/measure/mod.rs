//! How fast it is, how exact it is, and how one is known to be true of the other.
pub mod verify;
