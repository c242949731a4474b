"""Cartoon hair: NURBS surfaces to key hairs to clumps (Modelling and Animating Cartoon Hair)."""
