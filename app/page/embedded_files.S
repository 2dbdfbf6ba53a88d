// The files of a page as they are, in the program's read-only data; paths are CMake's.
  .section .rodata

  .macro embed name, file
  .global \name
  .global \name\()_end
\name:
  .incbin "\file"
\name\()_end:
  .byte 0
  .endm

  embed boresight_page_css, PAGE_CSS
  embed boresight_figures_js, FIGURES_JS
  embed boresight_what_if_js, WHAT_IF_JS

  // One script of several files.
  .global boresight_loop_sliders_js
  .global boresight_loop_sliders_js_end
boresight_loop_sliders_js:
  .incbin MATRICES_JS
  .incbin LOOP_MODEL_JS
  .incbin LOOP_ANALYSIS_JS
  .incbin LOOP_SLIDERS_JS
boresight_loop_sliders_js_end:
  .byte 0

#ifdef PLOTLY_JS
  embed boresight_plotly_js, PLOTLY_JS
#else
  .global boresight_plotly_js
  .global boresight_plotly_js_end
boresight_plotly_js:
boresight_plotly_js_end:
  .byte 0
#endif

  .section .note.GNU-stack,"",%progbits
