"""ulna beside CasADi and Pinocchio: see ../README.md."""
