"""Hair from one portrait photograph (Chai et al. 2012, section 3)."""
