# Read by ctest behind its list of tests: these start first, so that no core waits for a long one at the end.
set_tests_properties(All/ConvergedScenes.UncertaintyCoversTheTrueError/lead_screw All/ConvergedScenes.UncertaintyCoversTheTrueError/falling_beam
                     PROPERTIES COST 1000)
set_tests_properties(WhatGoesTogether.IsWhatTheDocsSay PROPERTIES COST 500)
