# `cpack --config build/release/CPackConfig.cmake`: damslip_<version>_<architecture>.deb with the program, its pages, examples, records and documents,
# and where the Python module is built python3-damslip_<version>_<architecture>.deb with the package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME damslip)
set(CPACK_PACKAGE_CONTACT "the damslip project <damslip@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "seismic sliding of concrete gravity dams and rock blocks")
set(CPACK_PACKAGE_DESCRIPTION "How far a gravity dam or rock block slides in an earthquake, and how sure the answer is: regressions,
rigid block integrated exactly, and a finite-element model of dam, rock, water and contact.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME damslip)
if(TARGET damslip_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR python_after "${DAMSLIP_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-damslip)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${DAMSLIP_PYTHON_MINOR}), python3 (<< 3.${python_after}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-pandas)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "damslip from Python: scenes, sweeps, histories as arrays")
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)   # a package for each
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)   # Depends from the libraries the program is linked to
include(CPack)
