# find_package(damslip): libraries damslip::core, ::scene, ::records, ::sliding, ::fe2d, ::analysis, each with all that is below its folder;
# each library has its own, too: damslip::fe2d_run, damslip::analysis_screen and so on.
include(CMakeFindDependencyMacro)
include(${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/damslipTargets.cmake)
