# What all figures of this study share, beside what all studies do.
load folder . "/../style.gp"
colour(i) = i == 1 ? "#08306b" : i == 2 ? "#d94801" : "#fd8d3c"
mark(i) = i == 1 ? 7 : i == 2 ? 5 : 4
