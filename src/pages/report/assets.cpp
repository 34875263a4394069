#include "pages/report/assets.hpp"

extern "C" {
extern const char damslip_uplot_js[], damslip_uplot_js_end[];
extern const char damslip_uplot_css[], damslip_uplot_css_end[];
extern const char damslip_uplot_license[], damslip_uplot_license_end[];
extern const char damslip_page_js[], damslip_page_js_end[];
extern const char damslip_state_map_js[], damslip_state_map_js_end[];
extern const char damslip_mesh_view_js[], damslip_mesh_view_js_end[];
extern const char damslip_page_css[], damslip_page_css_end[];
}

namespace damslip::pages {

std::string_view uplot_script()
{
    return {damslip_uplot_js, damslip_uplot_js_end};
}

std::string_view uplot_style()
{
    return {damslip_uplot_css, damslip_uplot_css_end};
}

std::string_view uplot_license()
{
    return {damslip_uplot_license, damslip_uplot_license_end};
}

std::string_view page_script()
{
    return {damslip_page_js, damslip_page_js_end};
}

std::string_view state_map_script()
{
    return {damslip_state_map_js, damslip_state_map_js_end};
}

std::string_view mesh_view_script()
{
    return {damslip_mesh_view_js, damslip_mesh_view_js_end};
}

std::string_view page_style()
{
    return {damslip_page_css, damslip_page_css_end};
}

} // namespace damslip::pages
