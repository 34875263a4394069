# find_package(damslip): libraries damslip::core, ::scene, ::records, ::sliding, ::fe2d, ::analysis, each with all that is below its folder;
# single folders of the others have their own, damslip::records_read and so on.
include(CMakeFindDependencyMacro)
include(${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/damslipTargets.cmake)
