#include "convert/claims.h"

#include <errno.h>
#include <string.h>

#include "convert/module.h"

weft_status wf_claims_read(const char *path, wf_claims *claims, weft_error *err) {
    void *symbol;
    wf_libav_claims_fn *ask;
    *claims = (wf_claims){.frames = -1, .frame_layout = -1, .dominance = -1, .siting = -1};
    if (!wf_module_built("libav"))
        return wf_fail(err, WEFT_FAILED,
                       "%.700s: containers are read through libav, which this weft was built "
                       "without: install libavformat-dev and libavcodec-dev and build it again",
                       path);
    weft_status status = wf_module_symbol("libav", "wf_libav_claims", &symbol, err);
    if (status) return status;
    memcpy(&ask, &symbol, sizeof ask);
    status = ask(path, claims, err);
    if (status) return status;
    FILE *file = fopen(path, "rbe");
    if (!file) return wf_fail(err, WEFT_FAILED, "%.700s: %s", path, strerror(errno));
    if (!strcmp(claims->container, "mov")) wf_claims_mov(file, claims);
    if (!strcmp(claims->container, "mxf")) wf_claims_mxf(file, claims);
    fclose(file);
    return WEFT_OK;
}
