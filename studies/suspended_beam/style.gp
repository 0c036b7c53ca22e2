# What all figures of this study share. Needs `output`; `width` and `height` in pixels.
set terminal svg size width,height font "sans-serif,15" enhanced background rgb "white" linewidth 1.2
set encoding utf8
set output output
set datafile separator comma
set border linewidth 0.8 linecolor rgb "#444444"
set tics nomirror scale 0.6 textcolor rgb "#222222"
set grid linewidth 0.5 linecolor rgb "#dddddd" linetype 1
set key noautotitle

csv(name) = data . name . ".csv"

element_name(e) = e eq "rancf" ? "ALE-RANCF" : "ALE-ANCF"
element_colour(e) = e eq "rancf" ? "#08519c" : e eq "ancf" ? "#d94801" : "#969696"

modes = "continuous tangent equal free"
mode_name(m) = m eq "equal" ? "equal-stretch" : m
mode_colour(m) = m eq "continuous" ? "#08519c" : m eq "tangent" ? "#6baed6" : m eq "equal" ? "#a63603" : "#fd8d3c"
mode_dash(m) = m eq "continuous" || m eq "equal" ? 1 : 2
mode_width(m) = m eq "continuous" || m eq "equal" ? 4 : 1.8
