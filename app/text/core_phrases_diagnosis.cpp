// Phrases of diagnosis, with the catalogue of its sentences.

#include <QCoreApplication>
#include <array>

#include "app/text/core_phrases.h"

namespace zerodrift {
namespace {

constexpr std::array<const char*, 142> diagnosis = {{
    QT_TRANSLATE_NOOP("core", "Beside what is named, {channels} show more that the library does not explain."),
    QT_TRANSLATE_NOOP("core", "Recording {recording} has no column {column}, which {other} has: it was left out."),
    QT_TRANSLATE_NOOP("core",
                      "Recording {recording} has no column {column}, which {other} has: what that switches is not "
                      "simulated, and {other} may be missed for it."),
    QT_TRANSLATE_NOOP("core",
                      "Nothing can be named: the simulation follows the recording only with numbers far from those "
                      "described. Check the units of the recording and the sizes and powers of the description first."),
    QT_TRANSLATE_NOOP("core", "Recording {@what}."),
    QT_TRANSLATE_NOOP("core", "Recording {recording}: {@what}."),
    QT_TRANSLATE_NOOP("core",
                      "Recording {recording}: the temperatures may be in degrees Fahrenheit but were taken as degrees "
                      "Celsius; give their unit in the column map."),
    QT_TRANSLATE_NOOP("core",
                      "Recording {recording}: the temperatures may be in kelvin but were taken as degrees Celsius; "
                      "give their unit in the column map."),
    QT_TRANSLATE_NOOP("core", "minutes"),
    QT_TRANSLATE_NOOP("core", "hours"),
    QT_TRANSLATE_NOOP("core", "milliseconds"),
    QT_TRANSLATE_NOOP("core", "a temperature that the simulation can follow"),
    QT_TRANSLATE_NOOP("core", "at least one"),
    QT_TRANSLATE_NOOP(
        "core",
        "two thirds of full speed, 40 % of the time without coolant, 35 % with it, then stop and record the cooling"),
    QT_TRANSLATE_NOOP("core", "full speed without coolant for half of the time, then stop and record the cooling"),
    QT_TRANSLATE_NOOP("core", "half speed without coolant"),
    QT_TRANSLATE_NOOP("core", "25, 50, 75 and 100 % of full speed, a quarter of the time each"),
    QT_TRANSLATE_NOOP("core", "full speed and stop in turn, four equal parts"),
    QT_TRANSLATE_NOOP("core", "full speed, coolant off and on in turn, four equal parts"),
    QT_TRANSLATE_NOOP("core", "half speed cold, full speed for half of the time, half speed hot, then stop"),
    QT_TRANSLATE_NOOP("core", "half speed, no cutting and cutting in turn, four equal parts"),
    QT_TRANSLATE_NOOP("core", "all the time"),
    QT_TRANSLATE_NOOP("core", "in step with the spindle speed"),
    QT_TRANSLATE_NOOP("core", "with the square of the spindle speed"),
    QT_TRANSLATE_NOOP("core", "while the spindle turns"),
    QT_TRANSLATE_NOOP("core", "while the coolant runs"),
    QT_TRANSLATE_NOOP("core", "while the machine cuts"),
    QT_TRANSLATE_NOOP("core", "as the room changes"),
    QT_TRANSLATE_NOOP("core", "at irregular times"),
    QT_TRANSLATE_NOOP("core", "column"),
    QT_TRANSLATE_NOOP("core", "component"),
    QT_TRANSLATE_NOOP(
        "core",
        "Nothing is missing: the simulation agrees with the recording within its tolerances and the sensors' noise."),
    QT_TRANSLATE_NOOP("core",
                      "The description holds {@name}, which the recording does not show; without it nothing is "
                      "missing. Take it out of the description, or check its numbers."),
    QT_TRANSLATE_NOOP("core",
                      "The description holds {@name}, which the recording does not show: what is named is beside the "
                      "description without it. Take it out, or check its numbers."),
    QT_TRANSLATE_NOOP(
        "core",
        "Nothing is missing of what this recording can show: the simulation agrees with it within its tolerances and "
        "the sensors' noise."),
    QT_TRANSLATE_NOOP(
        "core",
        "Something is missing that the library does not explain: worst at {channel}, {@regime}, about {watts} W."),
    QT_TRANSLATE_NOOP("core", "The simulation left out {+effects}."),
    QT_TRANSLATE_NOOP(
        "core",
        "{@regime}, {channel} is {before} {unit} (rms) off the best simulation without it. Adding {@name}{@where} "
        "({parameters}) removes {removed_percent} % of that{@heat}. Typical of it: {@fingerprint}."),
    QT_TRANSLATE_NOOP("core",
                      "{@regime}, adding {@name}{@where} ({parameters}) brings {channel} from {before} to {after} "
                      "{unit} (rms), of which {noise} {unit} is its noise{@heat}. Typical of it: {@fingerprint}."),
    QT_TRANSLATE_NOOP("core",
                      "{@regime}, adding {@name}{@where} ({parameters}) explains how {channel} goes (log evidence "
                      "{evidence}), but leaves it {before} {unit} (rms) off{@heat}. Typical of it: {@fingerprint}."),
    QT_TRANSLATE_NOOP("core", "full power for half of the time, then off, and record the cooling"),
    QT_TRANSLATE_NOOP("core", "full power and off in turn, four equal parts"),
    QT_TRANSLATE_NOOP("core", "25, 50, 75 and 100 % of full power, a quarter of the time each"),
    QT_TRANSLATE_NOOP("core",
                      "The heat capacity of {parts} is not described and was assumed: watts, W/K and J/K are in "
                      "proportion to it, the times are not."),
    QT_TRANSLATE_NOOP("core", "; it brings {watts} on average while it acts"),
    QT_TRANSLATE_NOOP("core", "; it takes away {watts} on average while it acts"),
    QT_TRANSLATE_NOOP("core",
                      "This recording is explained almost as well by {@name}{@where} (log evidence {behind} behind): "
                      "it cannot be excluded."),
    QT_TRANSLATE_NOOP("core", "To tell {@best} from {@rival}, {minutes} min in all: {@run}."),
    QT_TRANSLATE_NOOP("core", "The profile holds no machine description, so there is nothing to simulate."),
    QT_TRANSLATE_NOOP("core",
                      "The simulation differs most from the recording at {channel}: {rms} {unit} rms, {largest} {unit} "
                      "at the most after {minutes} min."),
    QT_TRANSLATE_NOOP("core",
                      "The temperature of {component} between {from} and {to} mm from its fixed end follows the "
                      "elongation best: a sensor belongs there."),
    QT_TRANSLATE_NOOP("core", " on {place_channel}"),
    QT_TRANSLATE_NOOP("core", " at {position} mm of {component}"),
    QT_TRANSLATE_NOOP("core", " between {from} and {to} mm"),
    QT_TRANSLATE_NOOP("core", " of {component}"),
    QT_TRANSLATE_NOOP("core", " and "),
    QT_TRANSLATE_NOOP("core", " or "),
    QT_TRANSLATE_NOOP("core", "convection to the room"),
    QT_TRANSLATE_NOOP("core", "convection that grows with speed"),
    QT_TRANSLATE_NOOP("core", "radiation to the room"),
    QT_TRANSLATE_NOOP("core", "cooling by the coolant"),
    QT_TRANSLATE_NOOP("core", "bearing oil that thins as it warms"),
    QT_TRANSLATE_NOOP("core", "a different bearing preload"),
    QT_TRANSLATE_NOOP("core", "bearing preload that grows with the heat"),
    QT_TRANSLATE_NOOP("core", "bearing preload that grows with speed"),
    QT_TRANSLATE_NOOP("core", "an extra heat source"),
    QT_TRANSLATE_NOOP("core", "a joint that conducts badly"),
    QT_TRANSLATE_NOOP("core", "the structure following the room"),
    QT_TRANSLATE_NOOP("core", "bending of the structure"),
    QT_TRANSLATE_NOOP("core", "a sensor that answers late"),
    QT_TRANSLATE_NOOP("core", "a sensor that reads wrong by a constant"),
    QT_TRANSLATE_NOOP("core", "a sensor that reads its rise wrong"),
    QT_TRANSLATE_NOOP("core", "heat of cutting at the nose"),
    QT_TRANSLATE_NOOP("core", "a draught or an open door"),
    QT_TRANSLATE_NOOP("core", "a chiller that switches on its own"),
    QT_TRANSLATE_NOOP("core", "bearings that run in"),
    QT_TRANSLATE_NOOP("core", "conductivity that changes with temperature"),
    QT_TRANSLATE_NOOP("core", "a wrong room sensor"),
    QT_TRANSLATE_NOOP("core", "a bracket that slipped"),
    QT_TRANSLATE_NOOP("core", "heat from a neighbouring part"),
    QT_TRANSLATE_NOOP("core", "the heat source's own body"),
    QT_TRANSLATE_NOOP("core", "a slow core behind the surface"),
    QT_TRANSLATE_NOOP("core", "a heat that is there at rest as well"),
    QT_TRANSLATE_NOOP("core", "heat as a curve over speed"),
    QT_TRANSLATE_NOOP("core", "a displacement that follows another part"),
    QT_TRANSLATE_NOOP("core", "heat that something unlogged switches"),
    QT_TRANSLATE_NOOP("core", "a film that a logged input drives"),
    QT_TRANSLATE_NOOP("core", "a structure that follows late"),
    QT_TRANSLATE_NOOP("core",
                      "Something is missing that the library does not explain: {channel} is off the best simulation by "
                      "{rms} {unit} (rms), {@regime}."),
    QT_TRANSLATE_NOOP(
        "core",
        "This recording cannot tell whether there is {|effects}: even as strong as it can be at all, it would not have "
        "shown here."),
    QT_TRANSLATE_NOOP("core",
                      "No effect of the library is missing, but the simulation agrees with the recording only with "
                      "numbers far from those described."),
    QT_TRANSLATE_NOOP("core",
                      "To fit, {@quantity} of {part} had to become {factor} times what is described, {widths} times "
                      "its tolerance: check units, sizes and powers."),
    QT_TRANSLATE_NOOP("core", "the heat"),
    QT_TRANSLATE_NOOP("core", "the conductivity"),
    QT_TRANSLATE_NOOP("core", "the heat capacity"),
    QT_TRANSLATE_NOOP("core", "the expansion"),
    QT_TRANSLATE_NOOP("core", "the film to the room"),
    QT_TRANSLATE_NOOP(
        "core",
        "This recording cannot tell whether anything is missing: the simulation agrees with it, but most effects of "
        "usual size would not have shown. Record for longer, until the temperatures settle, with several speeds and "
        "stops."),
    QT_TRANSLATE_NOOP("core",
                      "Nothing can be named: the sensors are not where the description has them. Correct that first."),
    QT_TRANSLATE_NOOP("core",
                      "{component} is described {described} mm thick: about {fits} mm explains the recording far "
                      "better. Measure its outer diameter."),
    QT_TRANSLATE_NOOP("core",
                      "The sensors of {component} read as if all of them sat about {fits} mm nearer to the fixed end "
                      "than described: check from where their places are told."),
    QT_TRANSLATE_NOOP("core",
                      "The sensors of {component} read as if all of them sat about {fits} mm farther from the fixed "
                      "end than described: check from where their places are told."),
    QT_TRANSLATE_NOOP("core",
                      "The sensors of {component} read as if their places were told from the other end than those of "
                      "its heat sources: count both from the fixed end."),
    QT_TRANSLATE_NOOP("core", "As heat it would come in between {from} and {to} mm of {component}."),
    QT_TRANSLATE_NOOP("core", "It shows most at {+spans} min."),
    QT_TRANSLATE_NOOP("core",
                      "{component} is described {described} mm long, with nothing on its last {bare} mm: a length of "
                      "about {fits} mm explains the recording far better. Measure it."),
    QT_TRANSLATE_NOOP("core",
                      "Nothing can be named: the machine does not have the sizes described. Correct that first."),
    QT_TRANSLATE_NOOP(
        "core",
        "{channel} reads as a sensor about {at} mm from the fixed end would, not one at {described} mm as described: "
        "check its place, and that it is in millimetres."),
    QT_TRANSLATE_NOOP("core",
                      "In {recording} the clock jumps ahead by {by} min at {at} min: the machine went on as if no time "
                      "had passed, and the "
                      "times were taken so."),
    QT_TRANSLATE_NOOP(
        "core", "The sensors read as if their places were described in {unit}, not in mm: correct the description."),
    QT_TRANSLATE_NOOP(
        "core",
        "{channel} and {other} read as if they had changed places: check their cables and the order of the columns."),
    QT_TRANSLATE_NOOP(
        "core",
        "The recording has no column {column}: how the room went had to be guessed from the machine's own "
        "temperatures, and what follows the room can hardly be told from it."),
    QT_TRANSLATE_NOOP("core", "The recording has no column {columns}: what shows in it alone cannot be found."),
    QT_TRANSLATE_NOOP("core",
                      "In {recording} the column {column} has no value in {percent} % of the rows: what it was there "
                      "had to be assumed."),
    QT_TRANSLATE_NOOP("core",
                      "What drives the machine was recorded about {seconds} s after it acted, and was taken as that "
                      "much earlier: give all columns one clock."),
    QT_TRANSLATE_NOOP("core",
                      "What drives the machine was recorded about {seconds} s before it acted, and was taken as that "
                      "much later: give all columns one clock."),
    QT_TRANSLATE_NOOP(
        "core",
        "The recording has no column {columns}: what acts with it cannot be found. If the machine has it, log it and "
        "record again."),
    QT_TRANSLATE_NOOP(
        "core",
        "The recording starts with {part} {above} K above its room: what ran before is not recorded and had to be "
        "fitted as well. Start after a rest of some hours to be surer."),
    QT_TRANSLATE_NOOP(
        "core",
        "The recording starts with {part} {above} K below its room: what ran before is not recorded and had to be "
        "fitted as well. Start after a rest of some hours to be surer."),
    QT_TRANSLATE_NOOP("core",
                      "Recording {recording}: the machine description does not name {columns}, which was not used."),
    QT_TRANSLATE_NOOP("core", "about {:.3g} um for {} (is it in mm?)"),
    QT_TRANSLATE_NOOP("core",
                      "This recording cannot tell whether there is {|effects}: what drives that never acted in it."),
    QT_TRANSLATE_NOOP(
        "core",
        "The rows are {seconds} s apart, and when speed or coolant switched in between is known no better: "
        "record a row every 60 s or more often to be surer."),
    QT_TRANSLATE_NOOP("core", ", "),
    QT_TRANSLATE_NOOP("core", "at most {:.3g} rpm"),
    QT_TRANSLATE_NOOP("core", "up to {:.4g} rpm"),
    QT_TRANSLATE_NOOP("core", "the speed in rpm (by {} it is in {})"),
    QT_TRANSLATE_NOOP("core", "speeds of a motor rated at {:g} rpm"),
    QT_TRANSLATE_NOOP("core",
                      "In {recording} the spindle's load is at most {most} W, next to nothing for this motor: is "
                      "spindle_load_W in {unit}?"),
    QT_TRANSLATE_NOOP("core", "speeds of a motor rated at {:g} rpm (are they in 1000 rpm?)"),
    QT_TRANSLATE_NOOP("core", "speeds of a motor rated at {:g} rpm (are they in % of that?)"),
    QT_TRANSLATE_NOOP("core", "0 rpm all the time beside a load of up to {:.4g} W"),
    QT_TRANSLATE_NOOP("core", "the spindle's speed (was it logged?)"),
    QT_TRANSLATE_NOOP("core", "Nothing drives the machine in this recording: little can be learned from it."),
    QT_TRANSLATE_NOOP("core",
                      "With its sign turned, {channel} is as described: check which way it counts as positive."),
    QT_TRANSLATE_NOOP("core", "To see whether there is {@rival}, {minutes} min in all: {@run}."),
    QT_TRANSLATE_NOOP("core",
                      "Something is missing that the library does not explain: worst at {channel}, {@regime}, where "
                      "about {watts} W too much heat is simulated."),
    QT_TRANSLATE_NOOP(
        "core",
        "Temperature sensors on {part} that were used: {count}. Where along it something happens can hardly be told "
        "from so few; three or more, spread over its length, show places."),
    QT_TRANSLATE_NOOP(
        "core",
        "The description states a smaller tolerance for {+quantities} than anybody can know such a number to: {values} "
        "was taken instead."),
    QT_TRANSLATE_NOOP("core",
                      "To fit, the joint {part} had to conduct {factor} times what is described, {widths} times its "
                      "tolerance: look at its seat, its bolts and what fills its gap, and then at its figure."),
    QT_TRANSLATE_NOOP("core", "the conductance of joints"),
    QT_TRANSLATE_NOOP(
        "core",
        "Recording {recording}: {channel} never changes (it is always {value}) although {um} µm are simulated: is the "
        "gauge connected? It was not used."),
}};

}  // namespace

std::span<const char* const> phrases_of_diagnosis() {
  return diagnosis;
}

}  // namespace zerodrift
