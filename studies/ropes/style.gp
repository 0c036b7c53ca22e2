# What all figures of this study share, beside what all studies do.
load folder . "/../style.gp"
set datafile missing NaN  # rows that are not of a curve do not break it
