"""Motion by physics: strips of a document are simulated and baked to keyframes."""
