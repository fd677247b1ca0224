#include "ui/text/contact_model_text.h"

#include <QCoreApplication>

#include <algorithm>
#include <array>

namespace marsview {
namespace {

constexpr std::array kWords{
    ContactModelWords{
        ContactModelKind::ContinuousWalk,
        //: A contact model: how the touching point (the proxy) follows the hand over the ground
        QT_TRANSLATE_NOOP("marsview::WindowActions", "&Continuous Walk (exact)"),
        //: Status tip of a contact model: its behavior and its cost
        QT_TRANSLATE_NOOP("marsview::WindowActions",
                          "Takes every point of the hand's way in turn, so that even fast strokes "
                          "end where slow ones would; each costs a little more time")},
    ContactModelWords{
        ContactModelKind::SurfaceWalk,
        //: A contact model: how the touching point (the proxy) follows the hand over the ground
        QT_TRANSLATE_NOOP("marsview::WindowActions", "&Surface Walk"),
        //: Status tip of a contact model: its behavior and its cost
        QT_TRANSLATE_NOOP("marsview::WindowActions",
                          "Slides downhill across faces, edges and corners of the ground; quick, "
                          "but a fast stroke may end in a neighboring dip")},
    ContactModelWords{
        ContactModelKind::ProxyGraph,
        //: A contact model: it walks on the graph of the vertices and edges of the ground
        QT_TRANSLATE_NOOP("marsview::WindowActions", "&Proxy Graph"),
        //: Status tip of a contact model: its behavior and its cost
        QT_TRANSLATE_NOOP("marsview::WindowActions",
                          "Goes along edges from corner to corner and on across faces; quick, but "
                          "a fast stroke ends in a neighboring dip more often")},
    ContactModelWords{
        ContactModelKind::ProxyGraph2003,
        //: A contact model: the proxy graph exactly as its paper describes it
        QT_TRANSLATE_NOOP("marsview::WindowActions", "Proxy Graph as Published (&2003)"),
        //: Status tip of a contact model: its behavior and its cost
        QT_TRANSLATE_NOOP("marsview::WindowActions",
                          "Follows the rules of the 2003 paper to the letter, for comparison; it "
                          "rests farther from the nearest point than the others do")},
    ContactModelWords{
        ContactModelKind::GodObject,
        //: A contact model, by the name that the literature gave it
        QT_TRANSLATE_NOOP("marsview::WindowActions", "&God-Object"),
        //: Status tip of a contact model: its behavior and its cost
        QT_TRANSLATE_NOOP("marsview::WindowActions",
                          "Stops at each face that it hits until the hand moves again; simple, "
                          "but it may stick or float for a moment")},
    ContactModelWords{
        ContactModelKind::GodObjectRelease,
        //: A contact model: a god-object that releases constraints
        QT_TRANSLATE_NOOP("marsview::WindowActions", "God-Object, Constraints &Released"),
        //: Status tip of a contact model: its behavior and its cost
        QT_TRANSLATE_NOOP("marsview::WindowActions",
                          "A god-object that releases faces as soon as they no longer hold it; "
                          "it does not stick, but searches for every face that it reaches")},
    ContactModelWords{
        ContactModelKind::VirtualProxy,
        //: A contact model: a sphere touches the ground in place of a point
        QT_TRANSLATE_NOOP("marsview::WindowActions", "&Virtual Proxy (sphere)"),
        //: Status tip of a contact model: its behavior and its cost
        QT_TRANSLATE_NOOP("marsview::WindowActions",
                          "Touches with a sphere as wide as a cell of the map; it rounds off sharp "
                          "ridges, but does not reach into narrow dips")},
};

} // namespace

std::span<const ContactModelWords> contactModelWords()
{
    return kWords;
}

QString contactModelText(ContactModelKind kind)
{
    const auto words = std::find_if(kWords.begin(), kWords.end(),
                                    [kind](const auto& known) { return known.model == kind; });
    QString text = words != kWords.end()
                       ? QCoreApplication::translate("marsview::WindowActions", words->text)
                       : QString();
    return text.remove(QLatin1Char('&'));
}

} // namespace marsview
