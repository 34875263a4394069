# Sources that are objects of their own where files of a folder are compiled together: tests/sabotage and tests/recipes link another one in their
# place. They are so with and without the tests, so that scripts/demo.sh and scripts/test.sh share what is compiled.
set(DAMSLIP_ALONE
  fe2d/contact/released_system.cpp fe2d/fluid/coupled_system.cpp fe2d/run/contact_stepper.cpp fe2d/run/dynamic_operator.cpp
  fe2d/run/ground_input.cpp fe2d/run/stages.cpp fe2d/time/linear_integrator.cpp fe2d/time/scheme.cpp
  records/read/format.cpp
  sliding/block/rigid_block.cpp sliding/block/slide.cpp sliding/empirical/regression_list.cpp sliding/empirical/regression_table.cpp
  src/cli/command_list.cpp src/scene/added_mass_list.cpp src/scene/effect_list.cpp src/scene/uplift_list.cpp)

# Compiled by itself for another processor from a point in it on.
list(APPEND DAMSLIP_ALONE sliding/block/permanent_contact_batch.cpp)

# Files of folders that are cold otherwise, through which every row of a sweep goes: compiled like the hot ones, by themselves.
set(DAMSLIP_PER_ROW
  src/analysis/prepare/rigid_model.cpp src/analysis/sweep/result_store.cpp src/analysis/sweep/sweep_axes.cpp
  src/analysis/sweep/sweep_grid.cpp src/analysis/sweep/sweep_run.cpp
  src/pages/report/csv_lines.cpp src/pages/sweep/sweep_rows_view.cpp src/pages/sweep/sweep_tables.cpp)

# For the tests that rely on it.
function(damslip_must_be_alone source)
  if(NOT source IN_LIST DAMSLIP_ALONE)
    message(FATAL_ERROR "${source} is to be linked in place of the library's: add it to cmake/alone.cmake")
  endif()
endfunction()
