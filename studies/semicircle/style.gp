# What all figures of this study share, beside what all studies do.
load folder . "/../style.gp"
mesh_colour(n) = n <= 4 ? "#bdbdbd" : n <= 8 ? "#fdae6b" : n <= 16 ? "#d94801" : n <= 32 ? "#4292c6" : "#08306b"
