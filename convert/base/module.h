#ifndef WF_CONVERT_BASE_MODULE_H
#define WF_CONVERT_BASE_MODULE_H

#include "convert/base/fail.h"

/* OpenImageIO costs 0.4 s and 120 MB to load, OpenColorIO and Cairo some milliseconds: more
 * than many a job takes; and not every machine has them, or libav. Each is behind a module that
 * is loaded when the first job needs it: weft/weft-NAME.so beside the library, or in the
 * directory the build was configured to install to. Modules stay loaded. Any thread. */

/* *symbol_out receives the address of symbol. `what` begins the message where there is no such
 * module: what needs it, as in "shot.tif: TIFF". */
weft_status wf_module_symbol(const char *name, const char *symbol, const char *what,
                             void **symbol_out, weft_error *err);

/* Whether the module is there, without loading it; else the same message. */
weft_status wf_module_check(const char *name, const char *what, weft_error *err);

#endif
