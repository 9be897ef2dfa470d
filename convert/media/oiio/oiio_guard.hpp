#ifndef WF_CONVERT_MEDIA_OIIO_OIIO_GUARD_HPP
#define WF_CONVERT_MEDIA_OIIO_OIIO_GUARD_HPP

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <string>

extern "C" {
#include "convert/base/fail.h"
}

// What the reading and the writing half of the OpenImageIO module share: nothing is thrown at
// C, and what OpenImageIO has to say becomes an error.
namespace oiio_guard {

// Threads are weft's own; those of OpenImageIO and OpenEXR would outlive the job.
inline void prepare() {
    static std::once_flag once;
    std::call_once(once, [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);
    });
}

// Runs work, of which nothing may be thrown at C.
template <typename Work> weft_status guarded(const char *what, weft_error *err, Work work) {
    try {
        prepare();
        return work();
    } catch (const std::bad_alloc &) {
        return wf_fail(err, WEFT_NO_MEMORY, "%.700s: out of memory", what);
    } catch (const std::exception &e) {
        return wf_fail(err, WEFT_FAILED, "%.600s: %.300s", what, e.what());
    } catch (...) {
        return wf_fail(err, WEFT_FAILED, "%.700s: OpenImageIO failed without saying why", what);
    }
}

// What a reader or writer has to say, which some leave out.
template <typename Unit>
weft_status trouble(Unit &unit, const char *what, const char *doing, weft_error *err) {
    std::string says = unit ? unit->geterror() : OIIO::geterror();
    std::replace(says.begin(), says.end(), '\n', ' ');
    if (says.empty()) says = "OpenImageIO does not say why; the file may be damaged";
    return wf_fail(err, WEFT_FAILED, "%.600s: it cannot be %s: %.300s", what, doing,
                   says.c_str());
}

} // namespace oiio_guard

#endif
