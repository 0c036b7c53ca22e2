# What all figures of this study share, beside what all studies do.
load folder . "/../style.gp"
# Light to dark with the number of elements.
mesh_colour(n) = n <= 5 ? "#9ecae1" : n <= 10 ? "#4292c6" : n <= 20 ? "#08519c" : n <= 30 ? "#fd8d3c" : "#a63603"
mesh_dash(n) = n <= 5 ? 2 : n <= 10 ? 4 : 1

element_name(e) = e eq "rancf" ? "ALE-RANCF" : "ALE-ANCF"
panel_title(e) = (e eq "rancf" ? "(a) " : "(b) ") . element_name(e)
