// The catalogue: effects, their signs and what the search for missing physics says.

#include "core/report/text/language.h"

namespace zerodrift::report {

std::vector<TextEntry> texts_of_physics() {
  return {
      {"Physics: simulation against recording", "物理分析：仿真与记录"},
      {"Where the simulation and the recording disagree", "仿真与记录不一致之处"},
      {"channels", "通道"},
      {"component", "部件"},
      {"from its fixed end, mm", "距固定端，mm"},
      {"{} to {}", "{} 至 {}"},
      {"when", "何时"},
      {"missing heat, W", "缺失热量，W"},
      {"Missing heat over position and time: {}", "缺失热量随位置和时间的分布：{}"},
      {"mm from the fixed end", "距固定端，mm"},
      {"Confidence: {} %.", "置信度：{} %。"},
      {"No other effect of the library explains this recording nearly as well.",
       "效应库中没有其他效应能同样好地解释本次记录。"},
      {"Effects found, with their parameters", "找到的效应及其参数"},
      {"effect", "效应"},
      {"parameters", "参数"},
      {"confidence, %", "置信度，%"},
      {"gain of log evidence", "对数证据增益"},
      {"Simulation against recording, RMS difference", "仿真与记录之差的均方根"},
      {"channel", "通道"},
      {"as described", "按原描述"},
      {"re-fitted without", "重新拟合，不含所找到的效应"},
      {"with what was found", "含所找到的效应"},
      {"noise of the sensor", "传感器噪声"},
      {"unseen, without", "未见数据，不含"},
      {"unseen, with", "未见数据，含"},
      {"recorded", "记录"},
      {"simulated", "仿真"},
      {"Recorded and simulated, channel by channel:", "各通道的记录与仿真："},
      {"Smallest effects that this recording would have shown", "本次记录所能发现的最小效应"},
      {"Nothing is missing: the simulation agrees with the recording within its tolerances and the sensors' noise.",
       "没有缺失：在容差和传感器噪声范围内，仿真与记录一致。"},
      {"The description holds {@name}, which the recording does not show; without it nothing is missing. Take it out "
       "of the description, or check its numbers.",
       "描述中含有{@name}，而记录并未显示；去掉它便没有缺失。请将其从描述中删除，或核对其数值。"},
      {"The description holds {@name}, which the recording does not show: what is named is beside the description "
       "without it. Take it out, or check its numbers.",
       "描述中含有{@name}，而记录并未显示：所命名的效应是针对去掉它之后的描述而言。请将其删除，或核对其数值。"},
      {"Nothing is missing of what this recording can show: the simulation agrees with it within its tolerances and "
       "the "
       "sensors' noise.",
       "在本记录所能显示的范围内没有缺失：在容差和传感器噪声范围内，仿真与记录一致。"},
      {"Something is missing that the library does not explain: worst at {channel}, {@regime}, about {watts} W.",
       "缺少效应库不能解释的因素：{channel} 处最明显，{@regime}，约 {watts} W。"},
      {"Something is missing that the library does not explain: what fits {channel} in this recording misses the "
       "machine's other recording by {um} µm (rms).",
       "存在效应库无法解释的缺失：与本次记录中的 {channel} 相符的仿真，在该机床的另一记录中相差 {um} µm（rms）。"},
      {"Something is missing that the library does not explain: {channel} is off the best simulation by {rms} {unit} "
       "(rms), "
       "{@regime}.",
       "缺少效应库不能解释的因素：{channel} 与最佳仿真相差 {rms} {unit}（均方根），{@regime}。"},
      {"This run at one speed would hardly show {@name}{@where}: it cannot be excluded.",
       "本次单一转速的运行几乎不会显示{@name}{@where}：不能排除。"},
      {"This recording cannot tell whether there is {|effects}: even as strong as it can be at all, it would not have "
       "shown here.",
       "本次记录无法判断是否存在{|effects}：即使它达到可能的最大强度，在本次记录中也不会显现。"},
      {"No effect of the library is missing, but the simulation agrees with the recording only with numbers far from "
       "those described.",
       "没有缺少效应库中的效应，但只有在参数与描述相差很大时，仿真才与记录一致。"},
      {"{@regime}, the best simulation without it follows {channel} only with {@quantity} of {part} at {factor} times "
       "what is described, {widths} times its tolerance. Adding {@name}{@where} ({parameters}) needs none of "
       "that{@heat}. Typical of it: {@fingerprint}.",
       "{@regime}，不计入该效应时，最佳仿真只有将{part}的{@quantity}取为所述值的 {factor} 倍（偏差为其容差的 {widths} "
       "倍）才与 {channel} 一致。计入{@where}{@name}（{parameters}）则无需如此{@heat}。典型特征：{@fingerprint}。"},
      {"With {@quantity} of {part} at {factor} times what is described, the recording is explained as well without "
       "{@name}: check that number first.",
       "若{part}的{@quantity}为所述值的 {factor} 倍，则不计入{@name}也能同样解释该记录：请先核对该数值。"},
      {"In {recording} the spindle's load is at most {most} W, next to nothing for this motor: is spindle_load_W in "
       "{unit}?",
       "{recording} 中主轴负载最大仅 {most} W，对该电机几乎为零：spindle_load_W 的单位是否为 {unit}？"},
      {"This recording cannot tell whether there is {|effects}: what drives that never acted in it.",
       "本次记录无法判断是否存在{|effects}：驱动它的输入从未动作。"},
      {"The rows are {seconds} s apart, and when speed or coolant switched in between is known no better: record a row "
       "every 60 s or more often to be surer.",
       "各行相隔 {seconds} s，其间转速或冷却切换的时刻无法知道得更准：要更可靠，请至少每 60 s 记录一行。"},
      {", ", "、"},
      {"To fit, {@quantity} of {part} had to become {factor} times what is described, {widths} times its tolerance: "
       "check units, sizes and powers.",
       "为了拟合，{part}的{@quantity}须为所述值的 {factor} 倍，偏差为其容差的 {widths} 倍：请检查单位、尺寸和功率。"},
      {"Nothing can be named: the simulation follows the recording only with numbers far from those described. Check "
       "the "
       "units of the recording and the sizes and powers of the description first.",
       "无法指明任何效应：只有在参数与描述相差很大时，仿真才与记录一致。请先检查记录的单位以及描述中的尺寸和功率。"},
      {"This recording cannot tell whether anything is missing: the simulation agrees with it, but most effects of "
       "usual size would not have shown. Record for longer, until the temperatures settle, with several speeds and "
       "stops.",
       "本次记录无法判断是否遗漏了什么：仿真与其一致，但大多数通常大小的效应在其中不会显现。请记录更长时间直至温度稳定"
       "，并包含多个转速和停机。"},
      {"Nothing can be named: the sensors are not where the description has them. Correct that first.",
       "无法指明任何效应：传感器的位置与描述不符。请先更正。"},
      {"{component} is described {described} mm thick: about {fits} mm explains the recording far better. Measure its "
       "outer diameter.",
       "{component} 描述为直径 {described} mm：若约为 {fits} mm，则能好得多地解释本次记录。请实测其外径。"},
      {"The sensors of {component} read as if all of them sat about {fits} mm nearer to the fixed end than described: "
       "check from where their places are told.",
       "{component} 的各传感器读数表明它们全都比描述中离固定端近约 {fits} mm：请检查其位置从何处量起。"},
      {"The sensors of {component} read as if all of them sat about {fits} mm farther from the fixed end than "
       "described: check from where their places are told.",
       "{component} 的各传感器读数表明它们全都比描述中离固定端远约 {fits} mm：请检查其位置从何处量起。"},
      {"The sensors of {component} read as if their places were told from the other end than those of its heat "
       "sources: count both from the fixed end.",
       "{component} 的传感器读数表明其位置与热源位置是从相反的两端量起的：两者都应从固定端量起。"},
      {"As heat it would come in between {from} and {to} mm of {component}.",
       "若视为热量，则由 {component} 的 {from} 至 {to} mm 处进入。"},
      {"It shows most at {+spans} min.", "在第 {+spans} 分钟最为明显。"},
      {"{component} is described {described} mm long, with nothing on its last {bare} mm: a length of about {fits} mm "
       "explains the recording far better. Measure it.",
       "{component} 描述为长 {described} mm，其末端 {bare} mm 上没有任何东西：若长约 {fits} "
       "mm，则能好得多地解释本次记录。请实测其长度。"},
      {"Nothing can be named: the machine does not have the sizes described. Correct that first.",
       "无法指明任何效应：机床的尺寸与描述不符。请先更正。"},
      {"{channel} reads as a sensor about {at} mm from the fixed end would, not one at {described} mm as described: "
       "check its place, and that it is in millimetres.",
       "{channel} 的读数像是距固定端约 {at} mm 处的传感器，而非描述中 {described} mm "
       "处的：请检查其位置以及单位是否为毫米。"},
      {"All but {channel} is explained by {+effects}: check that sensor and how it is mounted, then diagnose again.",
       "除 {channel} 外，其余均可由{+effects}解释：请检查该传感器及其安装方式，然后重新诊断。"},
      {"The same readings may come from {@name} at its described place: check it before you change the description.",
       "同样的读数也可能来自位置与描述一致的{@name}：更改描述之前请先检查该传感器。"},
      {"In {recording} the clock jumps ahead by {by} min at {at} min: the machine went on as if no time had passed, "
       "and the "
       "times were taken so.",
       "记录 {recording} 的时钟在第 {at} 分钟向前跳了 {by} 分钟：机床的变化表明其间没有时间流逝，时间已据此更正。"},
      {"The sensors read as if their places were described in {unit}, not in mm: correct the description.",
       "各传感器的读数表明其位置是以 {unit} 而非 mm 描述的：请更正描述。"},
      {"{channel} and {other} read as if they had changed places: check their cables and the order of the columns.",
       "{channel} 与 {other} 的读数像是互换了位置：请检查接线和列的顺序。"},
      {"The recording has no column {column}: how the room went had to be guessed from the machine's own "
       "temperatures, and what follows the room can hardly be told from it.",
       "记录中没有列 {column}：室温的变化只能由机床自身的温度推测，跟随室温的效应难以与之区分。"},
      {"The recording has no column {columns}: what acts with it cannot be found. If the machine has it, log it and "
       "record again.",
       "记录中没有列 {columns}：随之作用的效应无法查明。若机床有此项，请接入记录后重新测量。"},
      {"The recording has no column {columns}: what shows in it alone cannot be found.",
       "记录中没有列 {columns}：只在该列中显现的效应无法查明。"},
      {"What drives the machine was recorded about {seconds} s after it acted, and was taken as that much earlier: "
       "give all columns one clock.",
       "驱动机床各量的记录比其实际作用晚约 {seconds} s，已据此提前处理：请让各列使用同一时钟。"},
      {"What drives the machine was recorded about {seconds} s before it acted, and was taken as that much later: give "
       "all columns one clock.",
       "驱动机床各量的记录比其实际作用早约 {seconds} s，已据此推后处理：请让各列使用同一时钟。"},
      {"What drives the machine seems to be recorded {seconds} s or more after it acted: do all columns have one "
       "clock?",
       "驱动机床各量的记录似乎比其实际作用晚 {seconds} s 或更多：各列是否使用同一时钟？"},
      {"What drives the machine seems to be recorded {seconds} s or more before it acted: do all columns have one "
       "clock, or do all sensors answer late?",
       "驱动机床各量的记录似乎比其实际作用早 {seconds} s 或更多：各列是否使用同一时钟，或所有传感器都响应迟缓？"},
      {"Without {channel} nothing is missing: all other channels agree with the simulation. Check that sensor and how "
       "it is mounted before what is beside it.",
       "不计 {channel} 时一切吻合：其余各通道都与仿真一致。请先检查该传感器及其安装，再查其旁边的部位。"},
      {"It takes {@name} at the very limit of what it can be: check the numbers of the description that it changes "
       "first.",
       "须{@name}达到其可能的极限才能解释：请先核对说明中与之相关的数值。"},
      {"In {recording} the column {column} has no value in {percent} % of the rows: what it was there had to be "
       "assumed.",
       "{recording} 的列 {column} 有 {percent} % 的行没有数值：其间的值只能假定。"},
      {"The room's column jumps by {kelvin} K at {at} min, when the draught is said to begin: was its sensor moved or "
       "touched?",
       "室温列在 {at} min 处跳变 {kelvin} K，正是所述气流开始之时：室温传感器是否被移动或触碰？"},
      {"Nothing shows that {channel} follows the room: it moves by itself, as a clamp that creeps or a probe that "
       "drifts. Check how it is mounted.",
       "没有迹象表明 {channel} 跟随室温：它自行移动，如同夹具蠕变或测头漂移。请检查其安装。"},
      {"Whether {channel} follows the room or drifts by itself is not sure: the room went much the same way all the "
       "time. A run in which it turns would tell.",
       "{channel} 是跟随室温还是自行漂移尚不确定：室温几乎一直朝同一方向变化。在室温转向的一次运行中即可分辨。"},
      {"The recording starts with {part} {above} K above its room: what ran before is not recorded and had to be "
       "fitted as well. Start after a rest of some hours to be surer.",
       "记录开始时 {part} 比室温高 {above} K：此前的运行没有记录，只能一并拟合。静置数小时后再开始，结论会更可靠。"},
      {"The recording starts with {part} {above} K below its room: what ran before is not recorded and had to be "
       "fitted as well. Start after a rest of some hours to be surer.",
       "记录开始时 {part} 比室温低 {above} K：此前的运行没有记录，只能一并拟合。静置数小时后再开始，结论会更可靠。"},
      {"{recording}, which was held out, does not fit the machine that the fitted recording shows: {channel} is "
       "{after} {unit} (rms) off there, {here} here. Is it of another machine, or was something changed in between? "
       "It says nothing for or against the answer.",
       "留出的记录 {recording} 与拟合记录所示的机床不符：{channel} 在那里相差 {after} {unit}（均方根），在此为 "
       "{here}。它是否来自另一台机床，或其间有所改动？它既不支持也不否定此答案。"},
      {"Recording {recording}: the machine description does not name {columns}, which was not used.",
       "记录 {recording}：机床描述中没有 {columns}，未予使用。"},
      {"Recording {@what}.", "记录 {@what}。"},
      {"Something is missing that the library does not explain: worst at {channel}, {@regime}, where about {watts} W "
       "too much heat is simulated.",
       "缺少效应库不能解释的因素：{channel} 处最明显，{@regime}，仿真的热量约多出 {watts} W。"},
      {"What oil and preload do counts from the temperature at which each run starts, not from one that stays: the "
       "other recording, which starts at another, is predicted better so.",
       "润滑油和预紧的作用以每次运行开始时的温度为基准，而不是一个固定温度：另一份从不同温度开始的记录按此预测得更准"
       "。"},
      {"Temperature sensors on {part} that were used: {count}. Where along it something happens can hardly be told "
       "from so few; three or more, spread over its length, show places.",
       "{part} "
       "上所用的温度传感器数量：{count}"
       "。数量太少，难以判断现象发生在其何处；沿其长度布置三个或更多传感器才能显示位置。"},
      {"The description states a smaller tolerance for {+quantities} than anybody can know such a number to: {values} "
       "was taken instead.",
       "描述中{+quantities}的容差小于任何人所能确知的程度：已改用 {values}。"},
      {"To fit, the joint {part} had to conduct {factor} times what is described, {widths} times its tolerance: look "
       "at its seat, its bolts and what fills its gap, and then at its figure.",
       "为了吻合，接合处 {part} 的热导必须变为所述值的 {factor} 倍，是其容差的 {widths} "
       "倍：请先检查其配合面、螺栓和间隙中的填充物，再检查其数值。"},
      {"the conductance of joints", "接合处的热导"},
      {"Recording {recording}: {channel} never changes (it is always {value}) although {um} µm are simulated: is the "
       "gauge connected? It was not used.",
       "记录 {recording}：{channel} 始终不变（始终为 {value}），而仿真值变化了 {um} µm：测头是否已连接？未予使用。"},
      {"Recording {recording}: {@what}.", "记录 {recording}：{@what}。"},
      {"Recording {recording}: the temperatures may be in degrees Fahrenheit but were taken as degrees Celsius; give "
       "their unit in the column map.",
       "记录 {recording}：温度可能为华氏度，但已按摄氏度处理；请在列映射中给出单位。"},
      {"Recording {recording}: the temperatures may be in kelvin but were taken as degrees Celsius; give their unit in "
       "the column map.",
       "记录 {recording}：温度可能为开尔文，但已按摄氏度处理；请在列映射中给出单位。"},
      {"{}: {} of {} samples were used, from {} to {} min, for nothing was measured for {} min before or after them",
       "{0}：{2} 个采样中使用了 {1} 个（{3} 至 {4} min），因为其前或其后有 {5} min 未进行测量"},
      {"On {recording}, which was held out, the simulation is worse with it than re-fitted without it: {channel} is "
       "{after} {unit} (rms) off, not {before}.",
       "对于留出的记录 {recording}，加入该效应后的仿真比不含它重新拟合时更差：{channel} 相差 {after} "
       "{unit}（均方根），而非 {before}。"},
      {"On {recording}, which was held out, the simulation is worse with it than re-fitted without it: {channel} is "
       "{after} {unit} (rms) off, not {before}. What happened once need not have happened there.",
       "对于留出的记录 {recording}，加入该效应后的仿真比不含它重新拟合时更差：{channel} 相差 {after} "
       "{unit}（均方根），而非 {before}。只发生一次的事件在那里未必发生过。"},
      {"Recording {recording} has no column {column}, which {other} has: it was left out.",
       "记录 {recording} 没有 {other} 所含的列 {column}：未予采用。"},
      {"Recording {recording} has no column {column}, which {other} has: what that switches is not simulated, and "
       "{other} may be missed for it.",
       "记录 {recording} 没有 {other} 所含的列 {column}：其所控制的部分未被仿真，{other} 可能因此不符。"},
      {"from {} min on", "自 {} min 起"},
      {"from {} to {} min", "自 {} 至 {} min"},
      {"the heat", "发热量"},
      {"the conductivity", "导热系数"},
      {"the heat capacity", "热容"},
      {"the expansion", "热膨胀"},
      {"the film to the room", "对室内空气的换热"},
      {"Nothing drives the machine in this recording: little can be learned from it.",
       "本次记录中没有任何输入驱动机床：从中能得到的信息很少。"},
      {"With its sign turned, {channel} is as described: check which way it counts as positive.",
       "将符号反转后，{channel} 与描述一致：请检查哪个方向记为正。"},
      {"To see whether there is {@rival}, {minutes} min in all: {@run}.",
       "判断是否存在{@rival}的试验（共 {minutes} min）：{@run}。"},
      {"The simulation left out {+effects}.", "仿真遗漏了：{+effects}。"},
      {"{@regime}, {channel} is {before} {unit} (rms) off the best simulation without it. Adding {@name}{@where} "
       "({parameters}) removes {removed_percent} % of that{@heat}. Typical of it: {@fingerprint}.",
       "{@regime}，不含该效应时 {channel} 与最佳仿真相差 {before} "
       "{unit}（均方根）。加入{@name}{@where}（{parameters}）后消除其中的 {removed_percent} "
       "%{@heat}。其典型表现：{@fingerprint}。"},
      {"{@regime}, adding {@name}{@where} ({parameters}) brings {channel} from {before} to {after} {unit} (rms), of "
       "which {noise} {unit} is its noise{@heat}. Typical of it: {@fingerprint}.",
       "{@regime}，加入{@name}{@where}（{parameters}）后，{channel} 的偏差由 {before} 降至 {after} "
       "{unit}（均方根），其中 {noise} {unit} 为其噪声{@heat}。其典型表现：{@fingerprint}。"},
      {"{@regime}, adding {@name}{@where} ({parameters}) explains how {channel} goes (log evidence {evidence}), but "
       "leaves it {before} {unit} (rms) off{@heat}. Typical of it: {@fingerprint}.",
       "{@regime}，加入{@name}{@where}（{parameters}）可解释 {channel} 的变化过程（对数证据 {evidence}），但仍相差 "
       "{before} {unit}（均方根）{@heat}。其典型表现：{@fingerprint}。"},
      {"{@name}{@where} explains this recording less well (log evidence {behind} behind), but what is named does not "
       "explain all of it either: it cannot be excluded.",
       "{@name}{@where}对本次记录的解释较差（对数证据低 {behind}），但已命名的效应也未能完全解释：不能排除。"},
      {"full power for half of the time, then off, and record the cooling", "一半时间全功率，然后关闭并记录冷却过程"},
      {"full power and off in turn, four equal parts", "全功率与关闭交替，共四个等长阶段"},
      {"25, 50, 75 and 100 % of full power, a quarter of the time each",
       "满功率的 25、50、75 和 100 %，各占四分之一时间"},
      {"Beside what is named, {channels} show more that the library does not explain.",
       "除已命名的效应外，{channels} 还有效应库无法解释的偏差。"},
      {"Nothing of the library explains {channels}.", "效应库中没有任何效应能解释 {channels}。"},
      {"The heat capacity of {parts} is not described and was assumed: watts, W/K and J/K are in proportion to it, the "
       "times are not.",
       "{parts} 的热容未给出，采用了假定值：W、W/K 和 J/K 与其成正比，时间常数则不受影响。"},
      {"; it brings {watts} on average while it acts", "；起作用期间平均带入 {watts}"},
      {"; it takes away {watts} on average while it acts", "；起作用期间平均带走 {watts}"},
      {"This recording is explained almost as well by {@name}{@where} (log evidence {behind} behind): it cannot be "
       "excluded.",
       "{@name}{@where}对本次记录的解释几乎同样好（对数证据低 {behind}）：不能排除。"},
      {"To tell {@best} from {@rival}, {minutes} min in all: {@run}.",
       "区分{@best}与{@rival}的试验（共 {minutes} min）：{@run}。"},
      {"The profile holds no machine description, so there is nothing to simulate.",
       "配置中没有机床描述，因此无法仿真。"},
      {"The simulation differs most from the recording at {channel}: {rms} {unit} rms, {largest} {unit} at the most "
       "after {minutes} min.",
       "仿真与记录在 {channel} 处相差最大：均方根 {rms} {unit}，最大 {largest} {unit}，在 {minutes} min 时。"},
      {"The temperature of {component} between {from} and {to} mm from its fixed end follows the elongation best: a "
       "sensor belongs there.",
       "{component}上距固定端 {from} 至 {to} mm 处的温度与伸长最为一致：宜在此处布置传感器。"},
      {" on {place_channel}", "（{place_channel}）"},
      {" at {position} mm of {component}", "（{component} {position} mm 处）"},
      {" between {from} and {to} mm", "（{from} 至 {to} mm 之间）"},
      {" of {component}", "（{component}）"},
      {" and ", "、"},
      {" or ", "或"},
      {"convection to the room", "向环境的对流散热"},
      {"convection that grows with speed", "随转速增大的对流散热"},
      {"radiation to the room", "向环境的辐射散热"},
      {"cooling by the coolant", "冷却液的冷却"},
      {"bearing oil that thins as it warms", "轴承润滑油升温变稀"},
      {"a different bearing preload", "与描述不同的轴承预紧力"},
      {"bearing preload that grows with the heat", "轴承预紧力随发热增大"},
      {"bearing preload that grows with speed", "轴承预紧力随转速增大"},
      {"an extra heat source", "额外热源"},
      {"a joint that conducts badly", "导热不良的结合面"},
      {"the structure following the room", "结构随室温变化"},
      {"bending of the structure", "结构弯曲"},
      {"a sensor that answers late", "传感器响应滞后"},
      {"a sensor that reads wrong by a constant", "传感器存在固定偏差"},
      {"a sensor that reads its rise wrong", "传感器温升示值有误"},
      {"heat of cutting at the nose", "主轴端的切削热"},
      {"a draught or an open door", "气流或门敞开"},
      {"a chiller that switches on its own", "自行启停的冷却机"},
      {"bearings that run in", "轴承磨合"},
      {"conductivity that changes with temperature", "导热系数随温度变化"},
      {"a wrong room sensor", "室温传感器有误"},
      {"a bracket that slipped", "支架滑移"},
      {"heat from a neighbouring part", "相邻部件传来的热"},
      {"the heat source's own body", "热源自身的热容"},
      {"a slow core behind the surface", "表面之下响应缓慢的芯部"},
      {"a heat that is there at rest as well", "静止时也存在的热源"},
      {"heat as a curve over speed", "发热量随转速的曲线"},
      {"a displacement that follows another part", "位移跟随其他部件"},
      {"heat that something unlogged switches", "由未记录的开关控制的热量"},
      {"a film that a logged input drives", "由已记录输入驱动的换热"},
      {"a structure that follows late", "结构响应滞后"},
      {"in step with the spindle speed", "与主轴转速同步"},
      {"with the square of the spindle speed", "与主轴转速平方成比例"},
      {"while the spindle turns", "主轴旋转期间"},
      {"while the coolant runs", "冷却液开启期间"},
      {"while the machine cuts", "切削期间"},
      {"as the room changes", "随室温变化"},
      {"all the time", "始终"},
      {"at irregular times", "无规律"},
      {"two thirds of full speed, 40 % of the time without coolant, 35 % with it, then stop and record the cooling",
       "以全速的三分之二运行，40 % 的时间不开冷却液，35 % 的时间开冷却液，然后停机并记录冷却过程"},
      {"full speed without coolant for half of the time, then stop and record the cooling",
       "一半时间不开冷却液全速运行，然后停机并记录冷却过程"},
      {"25, 50, 75 and 100 % of full speed, a quarter of the time each",
       "以全速的 25、50、75 和 100 % 运行，各占四分之一时间"},
      {"half speed without coolant", "不开冷却液半速运行"},
      {"full speed and stop in turn, four equal parts", "全速与停机交替，共四个等长阶段"},
      {"full speed, coolant off and on in turn, four equal parts", "全速运行，冷却液关、开交替，共四个等长阶段"},
      {"half speed cold, full speed for half of the time, half speed hot, then stop",
       "冷态半速，一半时间全速，热态半速，然后停机"},
      {"half speed, no cutting and cutting in turn, four equal parts", "半速运行，不切削与切削交替，共四个等长阶段"},
      {"Bearings are simulated too cold - with less load than described, too hot - more so the warmer or the faster "
       "they run",
       "轴承的仿真温度偏低（载荷小于描述值时偏高），温度或转速越高偏差越大"},
      {"Bearings are simulated too cold in the first hours only, whatever the temperature is later",
       "轴承的仿真温度仅在最初几小时偏低，与其后的温度无关"},
      {"Bearings are simulated too cold at first and too hot later; friction falls as the oil warms",
       "轴承的仿真温度先偏低后偏高；摩擦随油温升高而减小"},
      {"One displacement jumps between two samples and stays there; no temperature moves. A gauge that was set to zero "
       "again and a probe that was touched look the same",
       "某个位移在两次采样之间跳变并保持；温度没有变化。测头重新置零或被碰动，看起来也是如此"},
      {"A surface starts fast and then goes on slowly, on the way up and on the way down",
       "表面温度先快后慢，升温和降温时均如此"},
      {"Temperatures saw with a period of their own that no logged input has",
       "温度呈锯齿波动，其周期与任何记录的输入都不同"},
      {"The hot parts conduct otherwise than the cold ones; gradients do not grow in proportion to the heat",
       "热区与冷区的导热不同；温度梯度不与热量成比例"},
      {"Opposite errors on the two sides of one place: the heated side too cold, the other too hot in the simulation",
       "某处两侧误差相反：仿真中受热侧偏冷，另一侧偏热"},
      {"All temperatures are simulated too hot, more so the longer it runs; the measured cool-down is faster",
       "所有仿真温度偏高，运行越久越明显；实测冷却更快"},
      {"The simulation is too hot from the moment the coolant runs; the error steps with coolant_on",
       "从冷却液开启起仿真温度偏高；误差随冷却液开关而跳变"},
      {"The nose is simulated too cold while the machine cuts", "切削时主轴端的仿真温度偏低"},
      {"All surfaces cool together during one stretch of time that no logged input explains. Coolant or compressed air "
       "that is not logged looks the same",
       "在某一时段所有表面同时变冷，记录的输入均不能解释。未记录的冷却液或压缩空气看起来也是如此"},
      {"One part warms and cools in stretches of time that no logged input explains",
       "某一部件在若干时段内升温、降温，记录的输入均不能解释"},
      {"The part cools faster while a logged input is on that the description does not use",
       "当某个描述中未使用的已记录输入开启时，该部件冷却更快"},
      {"One place is simulated too cold; the error is largest there and spreads both ways",
       "某处仿真温度偏低；误差在该处最大并向两侧扩散"},
      {"The heated end starts late and goes on warming after the heater is off",
       "受热端升温滞后，加热停止后仍继续升温"},
      {"A part without a source of its own warms after its neighbour does", "自身无热源的部件在相邻部件之后升温"},
      {"Like convection, but the hot part loses more than in proportion; below a rise of 20 K a tolerance of the film "
       "hides it",
       "与对流类似，但热区散热超出正比；温升低于 20 K 时会被换热系数的容差掩盖"},
      {"All temperatures tend to another level than the logged room, also while the machine stands",
       "所有温度都趋于与记录室温不同的水平，静止时也如此"},
      {"One channel is off in proportion to its rise, in step with it. A sensor that touches its part badly looks the "
       "same",
       "某一通道的偏差与其温升成比例且同步。传感器与部件接触不良看起来也是如此"},
      {"One channel is late in every transient and right when the temperature stands",
       "某一通道在每次变化时滞后，温度稳定时正确"},
      {"One channel differs by a constant from the first sample on", "某一通道从第一个采样起就有固定偏差"},
      {"The simulation is too hot while the spindle turns and right while it stands",
       "主轴旋转时仿真温度偏高，静止时正确"},
      {"At one speed the part is warmer than the laws in n and n^2 can make it beside the other speeds",
       "在某一转速下部件温度高于 n 与 n^2 规律所能给出的值"},
      {"The part is warmer than its surroundings even before the machine runs", "机床运行之前部件就比周围温度高"},
      {"Only displacements are off; they follow the room with a delay", "只有位移有偏差；其滞后地跟随室温"},
      {"Only the displacement across the axis is off; it follows a heat source or a temperature difference with a "
       "delay",
       "只有横向位移有偏差；其滞后地跟随热源或温差"},
      {"A displacement follows another part's temperature, heating and cooling alike",
       "某一位移跟随其他部件的温度，升温和降温时相同"},
      {"A displacement is late against the temperature of its own component; heating and cooling disagree",
       "位移滞后于所属部件的温度；升温与降温不一致"},
      {" = {} µm per unit of its driver", " = {} µm/驱动单位"},
      {"drift", "漂移"},
      {"gain", "增益"},
      {"excess", "超出"},
      {"step ", "阶跃 "},
      {"period", "周期"},
      {"slope", "斜率"},
      {"spindle", "主轴"},
      {"motor", "电机"},
      {"front bearing", "前轴承"},
      {"rear bearing", "后轴承"},
      {"column", "立柱"},
      {"bed", "床身"},
      {"table", "工作台"},
      {"headstock", "主轴箱"},
  };
}

}  // namespace zerodrift::report
