/* Files of this folder as bytes in the program; lengths by the difference of two labels. */
        .section .rodata
        .macro embed name, file
        .global damslip_\name, damslip_\name\()_end
damslip_\name:
        .incbin "\file"
damslip_\name\()_end:
        .byte 0
        .endm

        embed uplot_js, "pages/report/vendor/uplot/uPlot.iife.min.js"
        embed uplot_css, "pages/report/vendor/uplot/uPlot.min.css"
        embed uplot_license, "pages/report/vendor/uplot/LICENSE"
        embed page_js, "pages/report/page.js"
        embed state_map_js, "pages/report/state_map.js"
        embed mesh_view_js, "pages/report/mesh_view.js"
        embed page_css, "pages/report/page.css"

        .section .note.GNU-stack, "", %progbits
