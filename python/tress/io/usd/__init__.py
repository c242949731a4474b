"""Records as USD prims: plain descriptions, one mapping a file; `stage` alone knows `pxr`."""
