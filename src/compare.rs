//! Error figures between two pictures.
