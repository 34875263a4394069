# What `cmake --install` puts where:
#   runtime      bin/damslip, man pages, shell completion, share/damslip with examples and records, share/doc/damslip
#   development  include/damslip, lib/damslip/*.a, lib/cmake/damslip: find_package(damslip)
include(CMakePackageConfigHelpers)

# One library of damslip_folder. Its headers keep their paths ("scene/read.hpp") below include/damslip.
function(damslip_install_library target)
  string(REGEX REPLACE "^damslip_" "" name ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/damslip>)
  target_compile_features(${target} INTERFACE cxx_std_20)
  install(TARGETS ${target} EXPORT damslipTargets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/damslip COMPONENT development)
endfunction()

function(damslip_install_package)
  # All of a folder under one name; fe2d has its own.
  add_library(damslip_analysis INTERFACE)
  target_link_libraries(damslip_analysis INTERFACE analysis_assess)
  foreach(target fe2d damslip_analysis)
    damslip_install_library(${target})
  endforeach()

  foreach(folder src/core src/scene records sliding fe2d src/probability src/analysis)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/damslip COMPONENT development
            FILES_MATCHING PATTERN "*.hpp" PATTERN data EXCLUDE)
  endforeach()
  set(config ${CMAKE_INSTALL_LIBDIR}/cmake/damslip)
  install(EXPORT damslipTargets NAMESPACE damslip:: DESTINATION ${config} COMPONENT development)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/damslipConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/damslipConfig.cmake ${PROJECT_SOURCE_DIR}/cmake/dependencies.cmake
                ${PROJECT_BINARY_DIR}/damslipConfigVersion.cmake
          DESTINATION ${config} COMPONENT development)
endfunction()

# The examples with the records they name (../records/data), and the documents.
function(damslip_install_shared_files)
  set(data ${CMAKE_INSTALL_DATADIR}/damslip)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${data} COMPONENT runtime
          PATTERN "*_seeds" EXCLUDE PATTERN ".damslip-index.csv" EXCLUDE)   # records made of seeds
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/records/data DESTINATION ${data}/records COMPONENT runtime)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT runtime)
endfunction()

# What the program writes about itself: manual pages, and completion in the folders where the shells look for it.
function(damslip_install_pages)
  set(man ${PROJECT_BINARY_DIR}/man)
  set(completion ${PROJECT_BINARY_DIR}/completion)
  file(MAKE_DIRECTORY ${man} ${completion})
  add_custom_command(OUTPUT ${man}/damslip.1 ${completion}/bash ${completion}/zsh ${completion}/fish
    COMMAND damslip man --out ${man}
    COMMAND damslip completion bash > ${completion}/bash
    COMMAND damslip completion zsh > ${completion}/zsh
    COMMAND damslip completion fish > ${completion}/fish
    DEPENDS damslip VERBATIM)
  add_custom_target(damslip_pages ALL DEPENDS ${man}/damslip.1)
  install(DIRECTORY ${man}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime FILES_MATCHING PATTERN "*.1")
  install(FILES ${completion}/bash RENAME damslip
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT runtime)
  install(FILES ${completion}/zsh RENAME _damslip
          DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT runtime)
  install(FILES ${completion}/fish RENAME damslip.fish
          DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT runtime)
endfunction()
