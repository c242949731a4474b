//! Strands as flat arrays; one operation a file.
