"""Pictures of hair: GBuffers, styles, turntables."""
