"""How generated code grows with the number of joints: see ../README.md."""
