# What all figures of this study share, beside what all studies do.
load folder . "/../style.gp"
element_name(e) = e eq "rancf" ? "ALE-RANCF" : "ALE-ANCF"
element_colour(e) = e eq "rancf" ? "#08519c" : e eq "ancf" ? "#d94801" : "#969696"

modes = "continuous tangent equal free"
mode_name(m) = m eq "equal" ? "equal-stretch" : m
mode_colour(m) = m eq "continuous" ? "#08519c" : m eq "tangent" ? "#6baed6" : m eq "equal" ? "#a63603" : "#fd8d3c"
mode_dash(m) = m eq "continuous" || m eq "equal" ? 1 : 2
mode_width(m) = m eq "continuous" || m eq "equal" ? 4 : 1.8
