//! The oracle: double precision, on the CPU, written from the papers.
