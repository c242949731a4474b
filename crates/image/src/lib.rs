//! Image analysis for hair: Gabor bank, confidence, tracing, matting, completion.
