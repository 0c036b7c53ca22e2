# What the rest shape changes: strains from the initial shape, or from a straight beam.
width = 1200; height = 480
load folder . "/style.gp"
set multiplot layout 1,2 title "Rest shape, N = " . finest margins 0.07,0.97,0.13,0.82 spacing 0.1,0.1

set title "(a) configurations"
set size ratio -1
set xrange [-2.6:2.6]
set yrange [-2.6:0.7]
set xlabel "X (m)"
set ylabel "Y (m)"
set key top center horizontal
first = word(times, 1)
second = word(times, 2)
third = word(times, 3)
plot csv("shapes") using "asbuilt_".first."_x":"asbuilt_".first."_y" with lines linewidth 2 linecolor rgb "#999999" title "t = ".first." s", \
     "" using "asbuilt_".second."_x":"asbuilt_".second."_y" with lines linewidth 2 linecolor rgb "#4292c6" title "as-built, ".second." s", \
     "" using "asbuilt_".third."_x":"asbuilt_".third."_y" with lines linewidth 2 linecolor rgb "#08306b" title "as-built, ".third." s", \
     "" using "paper_".second."_x":"paper_".second."_y" with lines linewidth 2 linecolor rgb "#fdae6b" title "straight, ".second." s", \
     "" using "paper_".third."_x":"paper_".third."_y" with lines linewidth 2 linecolor rgb "#a63603" title "straight, ".third." s"
set size noratio
set autoscale

set title "(b) trajectory of the sliding node"
set xlabel "X (m)"
set ylabel "Y (m)"
set key top center vertical
plot csv("rest_history") using "mass_x_asbuilt":"mass_y_asbuilt" with lines linewidth 2 linecolor rgb "#08306b" title "as-built", \
     "" using "mass_x_paper":"mass_y_paper" with lines linewidth 2 linecolor rgb "#a63603" title "straight (the paper)"
unset multiplot
