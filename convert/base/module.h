#ifndef WF_CONVERT_BASE_MODULE_H
#define WF_CONVERT_BASE_MODULE_H

#include "convert/base/fail.h"

/* OpenImageIO costs 0.4 s and 120 MB to load, OpenColorIO and Cairo some milliseconds: more
 * than many a job takes. Each is behind a module that is loaded when the first job needs it:
 * weft/weft-NAME.so beside the library, or in the directory the build was configured to install
 * to. Modules stay loaded. *symbol_out receives the address of symbol. Any thread. */
weft_status wf_module_symbol(const char *name, const char *symbol, void **symbol_out,
                             weft_error *err);

/* Whether the module is there: some are left out where their library was not found. */
bool wf_module_built(const char *name);

#endif
