// Tells ThreadSanitizer what goes from one thread to another through Qt, which is not compiled for
// it: what was written before a call was posted, or a job begun, is there when it runs. The linker
// puts these in place of Qt's functions (--wrap), and calls go on to them.
#include <QMetaObject>
#include <QThreadPool>

#include <functional>
#include <sanitizer/tsan_interface.h>
#include <utility>

// Names that the linker asks for, of Qt's mangled ones.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {
bool __real__ZN11QMetaObject16invokeMethodImplEP7QObjectPN9QtPrivate15QSlotObjectBaseEN2Qt14ConnectionTypeEPv(
    QObject* object, QtPrivate::QSlotObjectBase* slot, Qt::ConnectionType type, void* result);
bool __wrap__ZN11QMetaObject16invokeMethodImplEP7QObjectPN9QtPrivate15QSlotObjectBaseEN2Qt14ConnectionTypeEPv(
    QObject* object, QtPrivate::QSlotObjectBase* slot, Qt::ConnectionType type, void* result)
{
    __tsan_release(object);
    return __real__ZN11QMetaObject16invokeMethodImplEP7QObjectPN9QtPrivate15QSlotObjectBaseEN2Qt14ConnectionTypeEPv(
        object, slot, type, result);
}

void __real__ZN11QThreadPool5startESt8functionIFvvEEi(QThreadPool* pool,
                                                      std::function<void()> job,
                                                      int priority);
void __wrap__ZN11QThreadPool5startESt8functionIFvvEEi(QThreadPool* pool,
                                                      std::function<void()> job,
                                                      int priority)
{
    __tsan_release(pool);
    __real__ZN11QThreadPool5startESt8functionIFvvEEi(
        pool,
        [pool, job = std::move(job)]() mutable {
            __tsan_acquire(pool);
            job();
            job = nullptr;
            __tsan_release(pool);
        },
        priority);
}

bool __real__ZN11QThreadPool11waitForDoneEi(QThreadPool* pool, int wait_ms);
bool __wrap__ZN11QThreadPool11waitForDoneEi(QThreadPool* pool, int wait_ms)
{
    const bool is_done = __real__ZN11QThreadPool11waitForDoneEi(pool, wait_ms);
    __tsan_acquire(pool);
    return is_done;
}

void __real__ZN11QThreadPoolD1Ev(QThreadPool* pool);
void __wrap__ZN11QThreadPoolD1Ev(QThreadPool* pool)
{
    __real__ZN11QThreadPoolD1Ev(pool);
    __tsan_acquire(pool);
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace {

// Before every event that an object gets.
bool acquireOf(void** receiver_event_result)
{
    __tsan_acquire(receiver_event_result[0]);
    return false; // Qt delivers it
}

[[maybe_unused]] const bool kIsRegistered =
    QInternal::registerCallback(QInternal::EventNotifyCallback, acquireOf);

} // namespace
