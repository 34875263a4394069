# Headers of other libraries that most files include, compiled once for all targets with the same flags: a second or more less for each file.
# Not where files are compiled one by one (the dev preset): there each has to include what it needs. Not with ccache, which by its default
# keeps nothing that was compiled so.
set(DAMSLIP_COMMON_HEADERS <algorithm> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string> <vector>)

# @param flags  a word for the target's flags: the first target with it has the headers compiled, the others use them too; ARGN: more headers
function(damslip_common_headers target flags)
  if(NOT CMAKE_UNITY_BUILD OR DAMSLIP_CCACHE)
    return()
  endif()
  get_property(first GLOBAL PROPERTY damslip_common_headers_${flags})
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    target_precompile_headers(${target} PRIVATE ${DAMSLIP_COMMON_HEADERS} ${ARGN})
    set_property(GLOBAL PROPERTY damslip_common_headers_${flags} ${target})
  endif()
endfunction()
