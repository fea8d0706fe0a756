<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN" sourcelanguage="en">
<context>
    <name>ColumnQuestion</name>
    <message>
        <source>both directions</source>
        <translation>双向</translation>
    </message>
    <message>
        <source>one direction</source>
        <translation>单向</translation>
    </message>
    <message>
        <source>%1 targets from %2 to %3 mm, %4; errors from %5 to %6 µm</source>
        <translation>%1 个目标位置，%2 至 %3 mm，%4；误差 %5 至 %6 µm</translation>
    </message>
</context>
<context>
    <name>Duration</name>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>%1 min</source>
        <translation>%1 min</translation>
    </message>
    <message>
        <source>%1 h %2 min</source>
        <translation>%1 h %2 min</translation>
    </message>
</context>
<context>
    <name>Figure</name>
    <message>
        <source>not yet</source>
        <translation>尚无</translation>
    </message>
    <message>
        <source>good</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>outside</source>
        <translation>超限</translation>
    </message>
    <message>
        <source>limit %1 %2</source>
        <translation>限值 %1 %2</translation>
    </message>
    <message>
        <source>at least %1 %2</source>
        <translation>至少 %1 %2</translation>
    </message>
    <message>
        <source>just outside</source>
        <translation>略超限</translation>
    </message>
</context>
<context>
    <name>FormWords</name>
    <message>
        <source>yes</source>
        <translation>是</translation>
    </message>
    <message>
        <source>no</source>
        <translation>否</translation>
    </message>
    <message>
        <source>Length</source>
        <translation>长度</translation>
    </message>
    <message>
        <source>From the fixed end, where it is held along x, to its free end</source>
        <translation>从固定端（沿 x 方向被固定处）到自由端</translation>
    </message>
    <message>
        <source>Outer diameter</source>
        <translation>外径</translation>
    </message>
    <message>
        <source>Bore</source>
        <translation>孔径</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>Material</source>
        <translation>材料</translation>
    </message>
    <message>
        <source>other</source>
        <translation>其他</translation>
    </message>
    <message>
        <source>Conductivity</source>
        <translation>导热系数</translation>
    </message>
    <message>
        <source>Density</source>
        <translation>密度</translation>
    </message>
    <message>
        <source>Heat capacity</source>
        <translation>热容</translation>
    </message>
    <message>
        <source>Expansion</source>
        <translation>热膨胀系数</translation>
    </message>
    <message>
        <source>not known: it is identified</source>
        <translation>未知：将被辨识</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>表面积</translation>
    </message>
    <message>
        <source>Its temperature is given</source>
        <translation>温度为给定值</translation>
    </message>
    <message>
        <source>The measured temperature is taken as it is, and not simulated: a bed, a cooling circuit</source>
        <translation>直接采用测得的温度而不仿真：床身、冷却回路</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>Rated power</source>
        <translation>额定功率</translation>
    </message>
    <message>
        <source>Efficiency</source>
        <translation>效率</translation>
    </message>
    <message>
        <source>Rated speed</source>
        <translation>额定转速</translation>
    </message>
    <message>
        <source>Mean diameter</source>
        <translation>平均直径</translation>
    </message>
    <message>
        <source>Lubrication f0</source>
        <translation>润滑系数 f0</translation>
    </message>
    <message>
        <source>Load factor f1</source>
        <translation>载荷系数 f1</translation>
    </message>
    <message>
        <source>Load, preload</source>
        <translation>载荷、预紧力</translation>
    </message>
    <message>
        <source>Oil viscosity</source>
        <translation>油黏度</translation>
    </message>
    <message>
        <source>Channel</source>
        <translation>通道</translation>
    </message>
    <message>
        <source>Heat for each unit</source>
        <translation>每单位发热量</translation>
    </message>
    <message>
        <source>Friction</source>
        <translation>摩擦力</translation>
    </message>
    <message>
        <source>Its size is not known</source>
        <translation>大小未知</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>类型</translation>
    </message>
    <message>
        <source>From</source>
        <translation>起点</translation>
    </message>
    <message>
        <source>Place from the fixed end of the part</source>
        <translation>距部件固定端的位置</translation>
    </message>
    <message>
        <source>To</source>
        <translation>终点</translation>
    </message>
    <message>
        <source>On</source>
        <translation>位于</translation>
    </message>
    <message>
        <source>ambient: it measures the room</source>
        <translation>ambient：测量室温</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>位置</translation>
    </message>
    <message>
        <source>Accuracy</source>
        <translation>准确度</translation>
    </message>
    <message>
        <source>Lag</source>
        <translation>滞后</translation>
    </message>
    <message>
        <source>Direction</source>
        <translation>方向</translation>
    </message>
    <message>
        <source>Expansion of</source>
        <translation>膨胀部件</translation>
    </message>
    <message>
        <source>Sign</source>
        <translation>符号</translation>
    </message>
    <message>
        <source>-1: it counts against the growth of the part</source>
        <translation>-1：与部件伸长方向相反</translation>
    </message>
    <message>
        <source>What else may move it</source>
        <translation>其他可能的位移</translation>
    </message>
    <message>
        <source>First part</source>
        <translation>部件一</translation>
    </message>
    <message>
        <source>Second part</source>
        <translation>部件二</translation>
    </message>
    <message>
        <source>at</source>
        <translation>位置</translation>
    </message>
    <message>
        <source>Conductance</source>
        <translation>热导</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>机床</translation>
    </message>
    <message>
        <source>Film to the air</source>
        <translation>对空气的换热系数</translation>
    </message>
    <message>
        <source>Temperature at the start</source>
        <translation>初始温度</translation>
    </message>
    <message>
        <source>the first sample</source>
        <translation>首个样本</translation>
    </message>
    <message>
        <source>Parts and their heat</source>
        <translation>部件及其热源</translation>
    </message>
    <message>
        <source>Couplings</source>
        <translation>热连接</translation>
    </message>
    <message>
        <source>Temperature sensors</source>
        <translation>温度传感器</translation>
    </message>
    <message>
        <source>Displacements</source>
        <translation>位移</translation>
    </message>
    <message>
        <source>losses of a motor</source>
        <translation>电机损耗</translation>
    </message>
    <message>
        <source>friction of a bearing</source>
        <translation>轴承摩擦</translation>
    </message>
    <message>
        <source>friction of a screw nut</source>
        <translation>丝杠螺母摩擦</translation>
    </message>
    <message>
        <source>friction of a guide</source>
        <translation>导轨摩擦</translation>
    </message>
    <message>
        <source>watts by a logged channel</source>
        <translation>按记录通道的功率</translation>
    </message>
    <message>
        <source>an unknown heat that follows the speed</source>
        <translation>随转速变化的未知热量</translation>
    </message>
</context>
<context>
    <name>ImportWords</name>
    <message>
        <source>holds words</source>
        <translation>只有文字</translation>
    </message>
    <message>
        <source>holds nothing</source>
        <translation>没有内容</translation>
    </message>
    <message>
        <source>counts the rows</source>
        <translation>行号</translation>
    </message>
    <message>
        <source>alarms of the logger</source>
        <translation>记录仪的报警</translation>
    </message>
    <message>
        <source>a second time</source>
        <translation>第二个时间</translation>
    </message>
    <message>
        <source>perhaps %1</source>
        <translation>可能是 %1</translation>
    </message>
    <message>
        <source>decimal comma</source>
        <translation>小数逗号</translation>
    </message>
    <message>
        <source>decimal point</source>
        <translation>小数点</translation>
    </message>
    <message>
        <source>comma</source>
        <translation>逗号</translation>
    </message>
    <message>
        <source>semicolon</source>
        <translation>分号</translation>
    </message>
    <message>
        <source>tab</source>
        <translation>制表符</translation>
    </message>
    <message>
        <source>blanks</source>
        <translation>空格</translation>
    </message>
    <message>
        <source>time in %1 from the start</source>
        <translation>时间自开始以 %1 计</translation>
    </message>
    <message>
        <source>time in %1 since 1970, from %2</source>
        <translation>时间自 1970 年以 %1 计，始于 %2</translation>
    </message>
    <message>
        <source>no time column: rows come evenly</source>
        <translation>没有时间列：各行间隔相等</translation>
    </message>
    <message>
        <source>time of day</source>
        <translation>时刻</translation>
    </message>
    <message>
        <source>date and time, from %1</source>
        <translation>日期和时间，始于 %1</translation>
    </message>
    <message>
        <source>date and time as %1, from %2</source>
        <translation>日期和时间（%1），始于 %2</translation>
    </message>
    <message>
        <source>sheet %1</source>
        <translation>工作表 %1</translation>
    </message>
    <message>
        <source>separated by %1</source>
        <translation>以%1分隔</translation>
    </message>
    <message>
        <source>%1 rows over %2</source>
        <translation>%1 行，历时 %2</translation>
    </message>
</context>
<context>
    <name>Lists</name>
    <message>
        <source>, </source>
        <comment>between the words of a list</comment>
        <translation>、</translation>
    </message>
</context>
<context>
    <name>Moment</name>
    <message>
        <source>d MMM yyyy, HH:mm</source>
        <comment>date and time, as QLocale writes it</comment>
        <translation>yyyy年M月d日 HH:mm</translation>
    </message>
    <message>
        <source>d MMM HH:mm</source>
        <comment>date and time, as QLocale writes it</comment>
        <translation>M月d日 HH:mm</translation>
    </message>
</context>
<context>
    <name>PhysicsView</name>
    <message>
        <source> at %1 mm</source>
        <translation>（%1 mm 处）</translation>
    </message>
    <message>
        <source>Cannot be told from: %1</source>
        <translation>无法与下列原因区分：%1</translation>
    </message>
    <message>
        <source>Nothing hidden</source>
        <translation>没有隐藏任何效应</translation>
    </message>
    <message>
        <source>Unexplained</source>
        <translation>无法解释</translation>
    </message>
    <message>
        <source>error in %1</source>
        <translation>%1 方向误差</translation>
    </message>
    <message>
        <source>Would have shown from %1 on</source>
        <translation>自 %1 起即可检出</translation>
    </message>
</context>
<context>
    <name>RigWords</name>
    <message>
        <source>yes</source>
        <translation>是</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>类型</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>地址</translation>
    </message>
    <message>
        <source>192.168.1.20, or a name</source>
        <translation>192.168.1.20 或主机名</translation>
    </message>
    <message>
        <source>Port</source>
        <translation>端口</translation>
    </message>
    <message>
        <source>Serial port</source>
        <translation>串口</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>波特率</translation>
    </message>
    <message>
        <source>baud</source>
        <translation>baud</translation>
    </message>
    <message>
        <source>Parity</source>
        <translation>校验</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>even</source>
        <translation>偶</translation>
    </message>
    <message>
        <source>odd</source>
        <translation>奇</translation>
    </message>
    <message>
        <source>Stop bits</source>
        <translation>停止位</translation>
    </message>
    <message>
        <source>Unit number</source>
        <translation>单元号</translation>
    </message>
    <message>
        <source>Register map</source>
        <translation>寄存器表</translation>
    </message>
    <message>
        <source>A map of this program, or a path to one beside the profile</source>
        <translation>本程序自带的寄存器表，或配置文件旁的文件路径</translation>
    </message>
    <message>
        <source>its own, in the profile</source>
        <translation>自有，保存在配置文件中</translation>
    </message>
    <message>
        <source>Registers that were changed here are a part of the profile. Another map replaces them.</source>
        <translation>在此修改的寄存器保存在配置文件中；选择其他寄存器表会取代它们。</translation>
    </message>
    <message>
        <source>Of register %1</source>
        <translation>寄存器 %1</translation>
    </message>
    <message>
        <source>First register</source>
        <translation>首寄存器</translation>
    </message>
    <message>
        <source>Function</source>
        <translation>功能</translation>
    </message>
    <message>
        <source>Type</source>
        <translation>数据类型</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>个数</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>比例</translation>
    </message>
    <message>
        <source>Time-out</source>
        <translation>超时</translation>
    </message>
    <message>
        <source>Read every</source>
        <translation>读取周期</translation>
    </message>
    <message>
        <source>Missing after</source>
        <translation>失效时间</translation>
    </message>
    <message>
        <source>Age from which a value that was not renewed is missing</source>
        <translation>数值超过此时间未更新即视为缺失</translation>
    </message>
    <message>
        <source>Control</source>
        <translation>控制器</translation>
    </message>
    <message>
        <source>Serial number</source>
        <translation>序列号</translation>
    </message>
    <message>
        <source>of the machine</source>
        <translation>机床的序列号</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>Broker</source>
        <translation>代理服务器</translation>
    </message>
    <message>
        <source>1883, or 8883 with TLS</source>
        <translation>1883，使用 TLS 时为 8883</translation>
    </message>
    <message>
        <source>TLS</source>
        <translation>TLS</translation>
    </message>
    <message>
        <source>no</source>
        <translation>否</translation>
    </message>
    <message>
        <source>Authority</source>
        <translation>证书颁发机构</translation>
    </message>
    <message>
        <source>the system&apos;s</source>
        <translation>系统自带</translation>
    </message>
    <message>
        <source>Login file</source>
        <translation>登录文件</translation>
    </message>
    <message>
        <source>Beside the profile, with user and password; only its owner may read it</source>
        <translation>位于配置文件旁，包含用户名和密码；仅其所有者可读</translation>
    </message>
    <message>
        <source>three periods of the slowest sensor</source>
        <translation>最慢传感器周期的三倍</translation>
    </message>
    <message>
        <source>Axes</source>
        <translation>轴</translation>
    </message>
    <message>
        <source>Machine axes that are seen to the right and up; the calibration finds scale and rotation</source>
        <translation>图像中向右和向上的机床轴；比例和旋转由标定确定</translation>
    </message>
    <message>
        <source>Target region</source>
        <translation>目标区域</translation>
    </message>
    <message>
        <source>x, y, width, height; or draw it in the preview</source>
        <translation>x、y、宽、高；或在预览中绘制</translation>
    </message>
    <message>
        <source>set in the camera itself</source>
        <translation>在相机中设置</translation>
    </message>
    <message>
        <source>as the camera is set</source>
        <translation>按相机当前设置</translation>
    </message>
    <message>
        <source>Exposure</source>
        <translation>曝光</translation>
    </message>
    <message>
        <source>Gain</source>
        <translation>增益</translation>
    </message>
    <message>
        <source>Expected scale</source>
        <translation>预期比例</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>机床</translation>
    </message>
    <message>
        <source>Measuring position %1</source>
        <translation>测量位置 %1</translation>
    </message>
    <message>
        <source>Errors by</source>
        <translation>误差来源</translation>
    </message>
    <message>
        <source>cameras</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>displacement probes</source>
        <translation>位移传感器</translation>
    </message>
    <message>
        <source>Calibration span</source>
        <translation>标定范围</translation>
    </message>
    <message>
        <source>Devices</source>
        <translation>设备</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>%1 since reading began</source>
        <translation>自开始读取以来变化 %1</translation>
    </message>
    <message>
        <source>Too bright: %1 % of the pixels are saturated.</source>
        <translation>过亮：%1 % 的像素已饱和。</translation>
    </message>
    <message>
        <source>Too dark: 99 % of the pixels are below %2 of 255.</source>
        <translation>过暗：99 % 的像素低于 %2（满值 255）。</translation>
    </message>
    <message>
        <source>Exposure is right: up to %2 of 255.</source>
        <translation>曝光合适：最高 %2（满值 255）。</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>no value</source>
        <translation>无数值</translation>
    </message>
    <message>
        <source>Modbus TCP</source>
        <translation>Modbus TCP</translation>
    </message>
    <message>
        <source>Modbus RTU, serial line</source>
        <translation>Modbus RTU（串行线路）</translation>
    </message>
    <message>
        <source>MQTT broker</source>
        <translation>MQTT 代理服务器</translation>
    </message>
    <message>
        <source>MTConnect agent</source>
        <translation>MTConnect 代理</translation>
    </message>
    <message>
        <source>By hand, no link</source>
        <translation>手动，无通信连接</translation>
    </message>
    <message>
        <source>8 × PT100, hundredths of a degree</source>
        <translation>8 路 PT100，分辨率 0.01 °C</translation>
    </message>
    <message>
        <source>8 × PT100, tenths of a degree</source>
        <translation>8 路 PT100，分辨率 0.1 °C</translation>
    </message>
    <message>
        <source>8 × DS18B20</source>
        <translation>8 路 DS18B20</translation>
    </message>
    <message>
        <source>Probe amplifier, 5 channels</source>
        <translation>位移传感器放大器，5 通道</translation>
    </message>
    <message>
        <source>Probe amplifier, 4 channels</source>
        <translation>位移传感器放大器，4 通道</translation>
    </message>
    <message>
        <source>Room temperature</source>
        <translation>室温</translation>
    </message>
    <message>
        <source>Spindle speed</source>
        <translation>主轴转速</translation>
    </message>
    <message>
        <source>Spindle load</source>
        <translation>主轴负载</translation>
    </message>
    <message>
        <source>Coolant</source>
        <translation>冷却液</translation>
    </message>
    <message>
        <source>Compensation switch</source>
        <translation>补偿开关</translation>
    </message>
    <message>
        <source>Position %1</source>
        <translation>位置 %1</translation>
    </message>
    <message>
        <source>Probe %1</source>
        <translation>位移传感器 %1</translation>
    </message>
    <message>
        <source>plausible</source>
        <translation>可信</translation>
    </message>
    <message>
        <source>never changes</source>
        <translation>始终不变</translation>
    </message>
    <message>
        <source>out of range</source>
        <translation>超出范围</translation>
    </message>
    <message>
        <source>the control</source>
        <translation>控制器</translation>
    </message>
    <message>
        <source>needed before a run, here or in its plan</source>
        <translation>运行前必须给出，在此处或运行计划中</translation>
    </message>
</context>
<context>
    <name>TableExport</name>
    <message>
        <source>Zerodrift table (*.json)</source>
        <translation>Zerodrift 补偿表 (*.json)</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>导出</translation>
    </message>
    <message>
        <source>Table saved: %1</source>
        <translation>补偿表已保存：%1</translation>
    </message>
    <message>
        <source>Exported: %1</source>
        <translation>已导出：%1</translation>
    </message>
    <message>
        <source>Lost: %1</source>
        <translation>有损失：%1</translation>
    </message>
    <message>
        <source>Expect: %1</source>
        <translation>预期：%1</translation>
    </message>
    <message>
        <source>Confirm on one point first: %1</source>
        <translation>请先用一个点确认：%1</translation>
    </message>
    <message>
        <source>LinuxCNC: screw compensation of one joint</source>
        <translation>LinuxCNC：单关节丝杠补偿</translation>
    </message>
    <message>
        <source>SINUMERIK: temperature compensation</source>
        <translation>SINUMERIK：温度补偿</translation>
    </message>
    <message>
        <source>SINUMERIK: leadscrew error compensation</source>
        <translation>SINUMERIK：丝杠误差补偿</translation>
    </message>
    <message>
        <source>FANUC: pitch error compensation</source>
        <translation>FANUC：螺距误差补偿</translation>
    </message>
    <message>
        <source>HEIDENHAIN: axis error compensation</source>
        <translation>HEIDENHAIN：轴误差补偿</translation>
    </message>
</context>
<context>
    <name>Typical</name>
    <message>
        <source>Steel, unalloyed</source>
        <translation>非合金钢</translation>
    </message>
    <message>
        <source>Bearing steel 100Cr6</source>
        <translation>轴承钢 100Cr6</translation>
    </message>
    <message>
        <source>Stainless steel</source>
        <translation>不锈钢</translation>
    </message>
    <message>
        <source>Grey cast iron</source>
        <translation>灰铸铁</translation>
    </message>
    <message>
        <source>Nodular cast iron</source>
        <translation>球墨铸铁</translation>
    </message>
    <message>
        <source>Aluminium alloy</source>
        <translation>铝合金</translation>
    </message>
    <message>
        <source>Brass</source>
        <translation>黄铜</translation>
    </message>
    <message>
        <source>Mineral casting</source>
        <translation>矿物铸件</translation>
    </message>
    <message>
        <source>Granite</source>
        <translation>花岗岩</translation>
    </message>
    <message>
        <source>Invar</source>
        <translation>殷钢</translation>
    </message>
    <message>
        <source>%1, %2 × %3</source>
        <translation>%1，%2 × %3</translation>
    </message>
    <message>
        <source>one row, oil mist or oil and air</source>
        <translation>单列，油雾或油气润滑</translation>
    </message>
    <message>
        <source>one row, grease</source>
        <translation>单列，脂润滑</translation>
    </message>
    <message>
        <source>one row, oil bath</source>
        <translation>单列，油浴</translation>
    </message>
    <message>
        <source>two rows, oil bath</source>
        <translation>双列，油浴</translation>
    </message>
    <message>
        <source>spindle grease, warm</source>
        <translation>主轴润滑脂，温热</translation>
    </message>
    <message>
        <source>still air, inside a cover</source>
        <translation>静止空气，罩内</translation>
    </message>
    <message>
        <source>workshop</source>
        <translation>车间</translation>
    </message>
    <message>
        <source>moved air, fan</source>
        <translation>流动空气，风扇</translation>
    </message>
    <message>
        <source>through balls or rollers</source>
        <translation>经由滚珠或滚子</translation>
    </message>
    <message>
        <source>small flange, bolted</source>
        <translation>小法兰，螺栓连接</translation>
    </message>
    <message>
        <source>large face, bolted and greased</source>
        <translation>大接合面，螺栓连接并涂脂</translation>
    </message>
    <message>
        <source>10 kg of steel</source>
        <translation>10 kg 钢</translation>
    </message>
    <message>
        <source>50 kg of steel</source>
        <translation>50 kg 钢</translation>
    </message>
    <message>
        <source>200 kg of cast iron</source>
        <translation>200 kg 铸铁</translation>
    </message>
    <message>
        <source>calibrated</source>
        <translation>已校准</translation>
    </message>
    <message>
        <source>resistance thermometer, class B</source>
        <translation>热电阻，B 级</translation>
    </message>
    <message>
        <source>thermocouple</source>
        <translation>热电偶</translation>
    </message>
</context>
<context>
    <name>UploadView</name>
    <message>
        <source>Room</source>
        <translation>室温</translation>
    </message>
    <message>
        <source>Constant</source>
        <translation>常数项</translation>
    </message>
    <message>
        <source>Point %1 mm</source>
        <translation>点 %1 mm</translation>
    </message>
    <message>
        <source>time of the warm-up run</source>
        <translation>暖机运行时间</translation>
    </message>
    <message>
        <source>position / mm</source>
        <translation>位置 / mm</translation>
    </message>
    <message>
        <source>Machine ready, table within its limits</source>
        <translation>机床就绪，补偿表在限值内</translation>
    </message>
    <message>
        <source>Old table read and kept</source>
        <translation>旧表已读取并保存</translation>
    </message>
    <message>
        <source>Compensation off</source>
        <translation>补偿断开</translation>
    </message>
    <message>
        <source>New table staged</source>
        <translation>新表已暂存</translation>
    </message>
    <message>
        <source>Read back and compared</source>
        <translation>已回读并比较</translation>
    </message>
    <message>
        <source>Count and check sum announced</source>
        <translation>已告知点数与校验和</translation>
    </message>
    <message>
        <source>Committed</source>
        <translation>已提交</translation>
    </message>
    <message>
        <source>Checked by the controller</source>
        <translation>控制器已校验</translation>
    </message>
    <message>
        <source>Active table compared</source>
        <translation>有效表已比较</translation>
    </message>
    <message>
        <source>Compensation on</source>
        <translation>补偿接通</translation>
    </message>
    <message>
        <source>Ramped in</source>
        <translation>渐变接入完成</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>完成</translation>
    </message>
    <message>
        <source>Restoring the old table</source>
        <translation>正在恢复旧表</translation>
    </message>
    <message>
        <source>The old table is active</source>
        <translation>旧表有效</translation>
    </message>
    <message>
        <source>The old table could not be restored</source>
        <translation>旧表无法恢复</translation>
    </message>
    <message>
        <source>same direction and size</source>
        <translation>方向和大小一致</translation>
    </message>
    <message>
        <source>not as commanded</source>
        <translation>与指令不符</translation>
    </message>
    <message>
        <source>no compensation</source>
        <translation>无补偿</translation>
    </message>
    <message>
        <source>%1, %2 registers</source>
        <translation>%1，%2 个寄存器</translation>
    </message>
    <message>
        <source>content not kept</source>
        <translation>内容未保留</translation>
    </message>
    <message>
        <source>%1 registers, not readable</source>
        <translation>%1 个寄存器，无法解读</translation>
    </message>
    <message>
        <source>empty at the start</source>
        <translation>最初为空</translation>
    </message>
    <message>
        <source>found in the machine</source>
        <translation>在机床中发现</translation>
    </message>
    <message>
        <source>upload</source>
        <translation>上传</translation>
    </message>
    <message>
        <source>correction</source>
        <translation>修正</translation>
    </message>
    <message>
        <source>rollback</source>
        <translation>回滚</translation>
    </message>
    <message>
        <source>rollback to %1</source>
        <translation>回滚到 %1</translation>
    </message>
    <message>
        <source>restored after a failed upload</source>
        <translation>上传失败后恢复</translation>
    </message>
    <message>
        <source>Version %1 is active; choose a former one.</source>
        <translation>版本 %1 当前生效；请选择以前的版本。</translation>
    </message>
    <message>
        <source>An older program kept only the check sum of version %1.</source>
        <translation>旧版程序只保留了版本 %1 的校验和。</translation>
    </message>
    <message>
        <source>Version %1 is the same table as the active one.</source>
        <translation>版本 %1 与当前生效的补偿表相同。</translation>
    </message>
</context>
<context>
    <name>ask</name>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
</context>
<context>
    <name>core</name>
    <message>
        <source>the kind of device %1</source>
        <translation>设备 %1 的类型</translation>
    </message>
    <message>
        <source>a control</source>
        <translation>控制器</translation>
    </message>
    <message>
        <source>a device to read</source>
        <translation>可读取的设备</translation>
    </message>
    <message>
        <source>the signal of device %1</source>
        <translation>设备 %1 的信号</translation>
    </message>
    <message>
        <source>one topic, without the wildcards + and #</source>
        <translation>一个主题，不含通配符 + 和 #</translation>
    </message>
    <message>
        <source>a topic, or topic#/path for a value in a JSON message</source>
        <translation>主题，或用 主题#/路径 表示 JSON 消息中的值</translation>
    </message>
    <message>
        <source>after # a JSON pointer such as /sensors/0/temperature</source>
        <translation># 之后为 JSON 指针，例如 /sensors/0/temperature</translation>
    </message>
    <message>
        <source>%1: the device says that it has no value</source>
        <translation>%1：设备报告没有数值</translation>
    </message>
    <message>
        <source>%1: a message is no number</source>
        <translation>%1：消息不是数字</translation>
    </message>
    <message>
        <source>%1: a message is no JSON</source>
        <translation>%1：消息不是 JSON</translation>
    </message>
    <message>
        <source>%1: a message has nothing at this path</source>
        <translation>%1：消息在该路径下没有内容</translation>
    </message>
    <message>
        <source>%1: a message has something other than a number at this path</source>
        <translation>%1：消息在该路径下的内容不是数字</translation>
    </message>
    <message>
        <source>%1: a message is larger than 1 MB</source>
        <translation>%1：消息超过 1 MB</translation>
    </message>
    <message>
        <source>%1: a retained message is not used, because its age is unknown</source>
        <translation>%1：未采用保留消息，因为不知道其产生时间</translation>
    </message>
    <message>
        <source>%1: the broker does not let this user read the topic</source>
        <translation>%1：MQTT 服务器不允许该用户读取此主题</translation>
    </message>
    <message>
        <source>%1 (%2 times)</source>
        <translation>%1（%2 次）</translation>
    </message>
    <message>
        <source>broker %1:%2</source>
        <translation>MQTT 服务器 %1:%2</translation>
    </message>
    <message>
        <source>no TLS connection: the broker&apos;s certificate is not of the authority given, or it does not speak TLS</source>
        <translation>无 TLS 连接：MQTT 服务器的证书并非由指定机构签发，或 MQTT 服务器不支持 TLS</translation>
    </message>
    <message>
        <source>the answer is not MQTT</source>
        <translation>应答不是 MQTT</translation>
    </message>
    <message>
        <source>the name of the host is not known</source>
        <translation>主机名未知</translation>
    </message>
    <message>
        <source>user and password go to the broker unencrypted, because TLS is off</source>
        <translation>由于未启用 TLS，用户名和密码以未加密方式发送给 MQTT 服务器</translation>
    </message>
    <message>
        <source>the broker refuses user or password</source>
        <translation>MQTT 服务器拒绝该用户名或密码</translation>
    </message>
    <message>
        <source>the connection to the broker was lost and opened anew</source>
        <translation>与 MQTT 服务器的连接曾中断，已重新建立</translation>
    </message>
    <message>
        <source>The mode of the file %1</source>
        <translation>文件 %1 的权限</translation>
    </message>
    <message>
        <source>0600, so that its owner alone may read it</source>
        <translation>0600，即仅其所有者可以读取</translation>
    </message>
    <message>
        <source>a text</source>
        <translation>文本</translation>
    </message>
    <message>
        <source>a text in quotation marks</source>
        <translation>引号内的文本</translation>
    </message>
    <message>
        <source>not a text</source>
        <translation>不是文本</translation>
    </message>
    <message>
        <source>its text is not repeated</source>
        <translation>不显示其内容</translation>
    </message>
    <message>
        <source>another kind of JSON</source>
        <translation>其他类型的 JSON</translation>
    </message>
    <message>
        <source>the address of device %1</source>
        <translation>设备 %1 的地址</translation>
    </message>
    <message>
        <source>an address without a user, who is in credentials_file</source>
        <translation>不含用户名的地址，用户名写在 credentials_file 中</translation>
    </message>
    <message>
        <source>an address such as http://host:5000/</source>
        <translation>地址，例如 http://host:5000/</translation>
    </message>
    <message>
        <source>http: this program was built without https</source>
        <translation>http：本程序编译时未包含 https</translation>
    </message>
    <message>
        <source>data item %1 of %2</source>
        <translation>%2 的数据项 %1</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>缺失</translation>
    </message>
    <message>
        <source>one of the ids %1</source>
        <translation>ID %1 之一</translation>
    </message>
    <message>
        <source>the name of several</source>
        <translation>多个数据项的名称</translation>
    </message>
    <message>
        <source>a condition</source>
        <translation>状态条件</translation>
    </message>
    <message>
        <source>a data item with a number</source>
        <translation>带数值的数据项</translation>
    </message>
    <message>
        <source>in %1</source>
        <translation>以 %1 为单位</translation>
    </message>
    <message>
        <source>no server answers there</source>
        <translation>该处没有服务器应答</translation>
    </message>
    <message>
        <source>no TLS connection: the agent&apos;s certificate is not of the authority given, or it is not https</source>
        <translation>无 TLS 连接：MTConnect 代理的证书并非由指定机构签发，或它不支持 https</translation>
    </message>
    <message>
        <source>the agent closed the connection before its answer was whole</source>
        <translation>MTConnect 代理在应答完整之前关闭了连接</translation>
    </message>
    <message>
        <source>it is longer than %1 MB</source>
        <translation>长度超过 %1 MB</translation>
    </message>
    <message>
        <source>the agent refuses user or password</source>
        <translation>MTConnect 代理拒绝该用户名或密码</translation>
    </message>
    <message>
        <source>the agent refers to another address, %1</source>
        <translation>MTConnect 代理指向另一个地址：%1</translation>
    </message>
    <message>
        <source>HTTP status %1</source>
        <translation>HTTP 状态 %1</translation>
    </message>
    <message>
        <source>it is no XML: %1</source>
        <translation>不是 XML：%1</translation>
    </message>
    <message>
        <source>the agent reports &quot;%1&quot;</source>
        <translation>MTConnect 代理报告“%1”</translation>
    </message>
    <message>
        <source>it is &lt;%1&gt; instead of &lt;%2&gt;</source>
        <translation>是 &lt;%1&gt;，而不是 &lt;%2&gt;</translation>
    </message>
    <message>
        <source>%1: the agent states no unit, and its values are taken as they are</source>
        <translation>%1：MTConnect 代理未说明单位，按原值使用</translation>
    </message>
    <message>
        <source>the agent has restarted, and its data items were read again</source>
        <translation>MTConnect 代理已重新启动，已重新读取其数据项</translation>
    </message>
    <message>
        <source>the agent keeps restarting</source>
        <translation>MTConnect 代理不断重新启动</translation>
    </message>
    <message>
        <source>%1: an answer of the agent lacks the data item</source>
        <translation>%1：MTConnect 代理的应答缺少该数据项</translation>
    </message>
    <message>
        <source>%1: a value is no number</source>
        <translation>%1：数值不是数字</translation>
    </message>
    <message>
        <source>user and password go to the agent unencrypted, because it is not https</source>
        <translation>由于不是 https，用户名和密码以未加密方式发送给 MTConnect 代理</translation>
    </message>
    <message>
        <source>is a folder</source>
        <translation>是文件夹</translation>
    </message>
    <message>
        <source>more than %1</source>
        <translation>多于 %1</translation>
    </message>
    <message>
        <source>SHA-256 is not available</source>
        <translation>SHA-256 不可用</translation>
    </message>
    <message>
        <source>syntax error %1</source>
        <translation>语法错误 %1</translation>
    </message>
    <message>
        <source>an object</source>
        <translation>对象</translation>
    </message>
    <message>
        <source>a whole number from %1</source>
        <translation>整数，从 %1</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 至 %2</translation>
    </message>
    <message>
        <source>true or false</source>
        <translation>true 或 false</translation>
    </message>
    <message>
        <source>a list of numbers</source>
        <translation>数值列表</translation>
    </message>
    <message>
        <source>a list of %1</source>
        <translation>%1 的列表</translation>
    </message>
    <message>
        <source>a list of texts</source>
        <translation>文本列表</translation>
    </message>
    <message>
        <source>a list of objects</source>
        <translation>对象列表</translation>
    </message>
    <message>
        <source>time stamp</source>
        <translation>时间戳</translation>
    </message>
    <message>
        <source>one that is in the job</source>
        <translation>作业中已有的</translation>
    </message>
    <message>
        <source>file of an artefact</source>
        <translation>工件数据的文件</translation>
    </message>
    <message>
        <source>one that belongs to artefact %1</source>
        <translation>属于数据 %1 的</translation>
    </message>
    <message>
        <source>%1 of artefact %2</source>
        <translation>数据 %2 的 %1</translation>
    </message>
    <message>
        <source>audit trail, entry %1: %2</source>
        <translation>审计记录，第 %1 条：%2</translation>
    </message>
    <message>
        <source>series %1, rows %2 to %3: checksum</source>
        <translation>序列 %1，第 %2 至 %3 行：校验和</translation>
    </message>
    <message>
        <source>series %1, row %2: checksum</source>
        <translation>序列 %1，第 %2 行：校验和</translation>
    </message>
    <message>
        <source>artefact %1, %2: checksum</source>
        <translation>数据 %1，%2：校验和</translation>
    </message>
    <message>
        <source>artefact %1 (%2): checksum</source>
        <translation>数据 %1（%2）：校验和</translation>
    </message>
    <message>
        <source>the file is there already</source>
        <translation>文件已存在</translation>
    </message>
    <message>
        <source>its older format needs updating</source>
        <translation>其旧格式需要更新</translation>
    </message>
    <message>
        <source>permission denied</source>
        <translation>没有权限</translation>
    </message>
    <message>
        <source>opened for reading</source>
        <translation>以只读方式打开</translation>
    </message>
    <message>
        <source>one that is not closed</source>
        <translation>尚未关闭的</translation>
    </message>
    <message>
        <source>values of a row</source>
        <translation>一行中的数值</translation>
    </message>
    <message>
        <source>time of a row</source>
        <translation>行的时间</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>after %1 s</source>
        <translation>%1 s 之后</translation>
    </message>
    <message>
        <source>channels of series %1</source>
        <translation>序列 %1 的通道</translation>
    </message>
    <message>
        <source>samples are stored in little endian</source>
        <translation>采样以小端格式存储</translation>
    </message>
    <message>
        <source>deflate failed on a buffer of its own bound</source>
        <translation>数据压缩失败</translation>
    </message>
    <message>
        <source>language of core&apos;s texts</source>
        <translation>中文</translation>
    </message>
    <message>
        <source>; </source>
        <translation>；</translation>
    </message>
    <message>
        <source>segments or points of the axis</source>
        <translation>该轴的分段或点</translation>
    </message>
    <message>
        <source>the axis table near %1 mm</source>
        <translation>%1 mm 附近的轴补偿表</translation>
    </message>
    <message>
        <source>positions or images that fall</source>
        <translation>位置或其映射值下降</translation>
    </message>
    <message>
        <source>both increasing</source>
        <translation>两者均递增</translation>
    </message>
    <message>
        <source>%1 at %2 C is outside the training range %3 to %4 C</source>
        <translation>%1 为 %2 °C，超出训练范围 %3 至 %4 °C</translation>
    </message>
    <message>
        <source>measuring model data</source>
        <translation>测量建模数据</translation>
    </message>
    <message>
        <source>staging a table</source>
        <translation>暂存补偿表</translation>
    </message>
    <message>
        <source>writing an offset</source>
        <translation>写入偏置</translation>
    </message>
    <message>
        <source>Compensation start</source>
        <translation>补偿起点</translation>
    </message>
    <message>
        <source>targets in %1</source>
        <translation>%1 中的目标位置</translation>
    </message>
    <message>
        <source>the number of targets in %1</source>
        <translation>%1 中的目标位置数</translation>
    </message>
    <message>
        <source>rows of numbers in %1</source>
        <translation>%1 中的数值行</translation>
    </message>
    <message>
        <source>%1 in mm</source>
        <translation>%1，单位 mm</translation>
    </message>
    <message>
        <source>%1 x %2 mm</source>
        <translation>%1，× %2 mm</translation>
    </message>
    <message>
        <source>%1 in um</source>
        <translation>%1，单位 µm</translation>
    </message>
    <message>
        <source>%1 x %2 um</source>
        <translation>%1，× %2 µm</translation>
    </message>
    <message>
        <source>%1column %2 is %3%4</source>
        <translation>%1第 %2 列为 %3%4</translation>
    </message>
    <message>
        <source>%1, the order tells the direction</source>
        <translation>%1，由顺序判断方向</translation>
    </message>
    <message>
        <source>%1, signs turned</source>
        <translation>%1，符号取反</translation>
    </message>
    <message>
        <source>the axes in %1</source>
        <translation>%1 中的轴</translation>
    </message>
    <message>
        <source>one, or the choice of one of them</source>
        <translation>一个轴，或从中选择一个</translation>
    </message>
    <message>
        <source>axis %1</source>
        <translation>轴 %1</translation>
    </message>
    <message>
        <source>the columns of %1</source>
        <translation>%1 的各列</translation>
    </message>
    <message>
        <source>no position</source>
        <translation>没有位置</translation>
    </message>
    <message>
        <source>one column of positions</source>
        <translation>一列位置</translation>
    </message>
    <message>
        <source>%1: read as: %2; confirm the sign on one point</source>
        <translation>%1：按以下方式读取：%2；请用一个点确认符号</translation>
    </message>
    <message>
        <source>no targets</source>
        <translation>没有目标位置</translation>
    </message>
    <message>
        <source>no deviations</source>
        <translation>没有偏差值</translation>
    </message>
    <message>
        <source>a linear report with TARGET DATA:: and DEVIATIONS::</source>
        <translation>含 TARGET DATA:: 和 DEVIATIONS:: 的直线测量报告</translation>
    </message>
    <message>
        <source>%1: compensation values in %2 are taken as -error; confirm sign and unit on one point</source>
        <translation>%1：%2 中的补偿值按 -误差 处理；请用一个点确认符号和单位</translation>
    </message>
    <message>
        <source>%1: values in mm are taken as -error, as the known reader does; confirm the sign on one point</source>
        <translation>%1：以 mm 表示的值按 -误差 处理，与通用读取程序一致；请用一个点确认符号</translation>
    </message>
    <message>
        <source>the error %1 is no axis of the table and is left out</source>
        <translation>误差 %1 不对应补偿表的任何轴，已略去</translation>
    </message>
    <message>
        <source>the model&apos;s errors dX_um, dY_um, dZ_um with temperature terms</source>
        <translation>模型的误差 dX_um、dY_um、dZ_um 及温度项</translation>
    </message>
    <message>
        <source>the model is dynamic; its static approximation in the table leaves %1 % more error</source>
        <translation>模型为动态模型；补偿表中的静态近似会多留下 %1 % 的误差</translation>
    </message>
    <message>
        <source>the axis tables</source>
        <translation>各轴补偿表</translation>
    </message>
    <message>
        <source>two with points for axis %1</source>
        <translation>轴 %1 有两个带点的表</translation>
    </message>
    <message>
        <source>one table for each axis</source>
        <translation>每轴一个补偿表</translation>
    </message>
    <message>
        <source>%1 measurements are too few to correct anything</source>
        <translation>%1 次测量太少，无法修正</translation>
    </message>
    <message>
        <source>%1 of %2 measurements exceed %3 um: no need to correct</source>
        <translation>%2 次测量中有 %1 次超过 %3 µm：无需修正</translation>
    </message>
    <message>
        <source>the temperature terms are multiplied by %1</source>
        <translation>温度项乘以 %1</translation>
    </message>
    <message>
        <source>the prediction is near zero, so the offset is moved by %1 um</source>
        <translation>预测值接近零，因此将偏置移动 %1 µm</translation>
    </message>
    <message>
        <source>the temperature terms are multiplied by %1 and the offset is moved by %2 um</source>
        <translation>温度项乘以 %1，偏置移动 %2 µm</translation>
    </message>
    <message>
        <source>no correction of the temperature terms makes the residual smaller</source>
        <translation>任何温度项修正都不能减小残差</translation>
    </message>
    <message>
        <source>%1 coefficients and the offset (%2 um) were updated</source>
        <translation>已更新 %1 个系数和偏置（%2 µm）</translation>
    </message>
    <message>
        <source>criterion: |r| of position and error at least %1, from %2 points</source>
        <translation>判据：位置与误差的 |r| 至少为 %1，自 %2 点起</translation>
    </message>
    <message>
        <source>r is blind to scale: it says nothing about um; the largest residual is %1 um at %2 mm</source>
        <translation>r 与尺度无关，不反映 µm 大小；最大残差为 %1 µm，位于 %2 mm 处</translation>
    </message>
    <message>
        <source>criterion: |r| of position and measured position at least %1; with laser data it is always about 1, so it can never drop a point: use errors or a tolerance</source>
        <translation>判据：位置与实测位置的 |r| 至少为 %1；对激光数据 r 始终约等于 1，因此永远不会剔除点：请改用误差或容差</translation>
    </message>
    <message>
        <source>criterion: the fewest segments that stay within %1 um at every point; the largest residual is %2 um</source>
        <translation>判据：每个点都在 %1 µm 以内的最少分段；最大残差为 %2 µm</translation>
    </message>
    <message>
        <source>measured positions of the axis</source>
        <translation>该轴的实测位置</translation>
    </message>
    <message>
        <source>start points</source>
        <translation>起始点数</translation>
    </message>
    <message>
        <source>2 or more</source>
        <translation>2 或更多</translation>
    </message>
    <message>
        <source>above 0, up to 1</source>
        <translation>大于 0，不超过 1</translation>
    </message>
    <message>
        <source>above 0 um</source>
        <translation>大于 0 µm</translation>
    </message>
    <message>
        <source>above the one before</source>
        <translation>大于前一个</translation>
    </message>
    <message>
        <source>the error between %1 and %2 mm</source>
        <translation>%1 与 %2 mm 之间的误差</translation>
    </message>
    <message>
        <source>one that turns the direction of motion</source>
        <translation>使运动方向反转的值</translation>
    </message>
    <message>
        <source>far less than the travel</source>
        <translation>远小于行程</translation>
    </message>
    <message>
        <source>point %1</source>
        <translation>点 %1</translation>
    </message>
    <message>
        <source>a finite number</source>
        <translation>有限的数值</translation>
    </message>
    <message>
        <source>a position above the one before</source>
        <translation>大于前一个的位置</translation>
    </message>
    <message>
        <source>term of %1</source>
        <translation>%1 的项</translation>
    </message>
    <message>
        <source>a channel name</source>
        <translation>通道名称</translation>
    </message>
    <message>
        <source>a number above 0</source>
        <translation>大于 0 的数值</translation>
    </message>
    <message>
        <source>%1 %2 C (valid %3 to %4)</source>
        <translation>%1 %2 °C（有效范围 %3 至 %4）</translation>
    </message>
    <message>
        <source>the coefficient of %1 in axis %2</source>
        <translation>%1 在轴 %2 中的系数</translation>
    </message>
    <message>
        <source>%1 um/K</source>
        <translation>%1 µm/K</translation>
    </message>
    <message>
        <source>the point at %1 mm</source>
        <translation>%1 mm 处的点</translation>
    </message>
    <message>
        <source>not below from_mm</source>
        <translation>不小于 from_mm</translation>
    </message>
    <message>
        <source>%1 numbers</source>
        <translation>%1 个数值</translation>
    </message>
    <message>
        <source>one for each of the %1 terms, or none</source>
        <translation>%1 个项各一个，或都没有</translation>
    </message>
    <message>
        <source>the host offset</source>
        <translation>上位机偏置</translation>
    </message>
    <message>
        <source>one to write to</source>
        <translation>一个可写入的偏置</translation>
    </message>
    <message>
        <source>the spindle&apos;s speed</source>
        <translation>主轴转速</translation>
    </message>
    <message>
        <source>%1 rpm</source>
        <translation>%1 r/min</translation>
    </message>
    <message>
        <source>%1 rpm, as this run commanded</source>
        <translation>本次运行所指令的 %1 r/min</translation>
    </message>
    <message>
        <source>the controller&apos;s own table</source>
        <translation>控制器自身的补偿表</translation>
    </message>
    <message>
        <source>an active one (version %1) that compensates already</source>
        <translation>已有正在补偿的有效表（版本 %1）</translation>
    </message>
    <message>
        <source>none beside the host compensator; roll it back first</source>
        <translation>使用上位机补偿器时不应有补偿表；请先回滚</translation>
    </message>
    <message>
        <source>the compensation switch is off</source>
        <translation>补偿开关已断开</translation>
    </message>
    <message>
        <source>its heartbeat</source>
        <translation>其心跳信号</translation>
    </message>
    <message>
        <source>check sum wrong</source>
        <translation>校验和错误</translation>
    </message>
    <message>
        <source>3 (read holding registers)</source>
        <translation>3（读保持寄存器）</translation>
    </message>
    <message>
        <source>4 (read input registers)</source>
        <translation>4（读输入寄存器）</translation>
    </message>
    <message>
        <source>6 (write a single register)</source>
        <translation>6（写单个寄存器）</translation>
    </message>
    <message>
        <source>16 (write several registers)</source>
        <translation>16（写多个寄存器）</translation>
    </message>
    <message>
        <source>6 or 16 (write registers)</source>
        <translation>6 或 16（写寄存器）</translation>
    </message>
    <message>
        <source>the serial adapter hears what it sends (local echo); the copies are dropped, its echo is better switched off</source>
        <translation>串口适配器会收到自己发送的数据（本地回显）；回显已丢弃，最好关闭其回显功能</translation>
    </message>
    <message>
        <source>zero bytes come before the replies and are dropped; check the termination and the bias of the serial line</source>
        <translation>应答前出现零字节，已丢弃；请检查串行线路的终端电阻和偏置</translation>
    </message>
    <message>
        <source>the controller has no function 6 (write a single register); function 16 is used</source>
        <translation>控制器没有功能码 6（写单个寄存器）；改用功能码 16</translation>
    </message>
    <message>
        <source>taking the offset out</source>
        <translation>撤除偏置</translation>
    </message>
    <message>
        <source>the controller keeps the offset</source>
        <translation>控制器仍保持偏置</translation>
    </message>
    <message>
        <source>unknown, last read X %1, Y %2, Z %3 um</source>
        <translation>未知，上次读取 X %1、Y %2、Z %3 um</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>X %1, Y %2, Z %3 um</source>
        <translation>X %1、Y %2、Z %3 um</translation>
    </message>
    <message>
        <source>it was stopped</source>
        <translation>已被停止</translation>
    </message>
    <message>
        <source>the sign check is done</source>
        <translation>符号检查已完成</translation>
    </message>
    <message>
        <source>the controller holds an offset already: X %1, Y %2, Z %3 um</source>
        <translation>控制器中已有偏置：X %1、Y %2、Z %3 um</translation>
    </message>
    <message>
        <source>compensating</source>
        <translation>补偿</translation>
    </message>
    <message>
        <source>the number of values of %1</source>
        <translation>%1 的数值个数</translation>
    </message>
    <message>
        <source>Compensating</source>
        <translation>补偿</translation>
    </message>
    <message>
        <source>wrong serial settings</source>
        <translation>串口参数错误</translation>
    </message>
    <message>
        <source>length %1</source>
        <translation>长度 %1</translation>
    </message>
    <message>
        <source>%1 bytes only</source>
        <translation>仅 %1 字节</translation>
    </message>
    <message>
        <source>transaction %1 instead of %2</source>
        <translation>事务号为 %1，应为 %2</translation>
    </message>
    <message>
        <source>protocol %1</source>
        <translation>协议号 %1</translation>
    </message>
    <message>
        <source>length %1 for %2 bytes</source>
        <translation>长度字段 %1，实际 %2 字节</translation>
    </message>
    <message>
        <source>unit %1, not %2</source>
        <translation>单元号为 %1，应为 %2</translation>
    </message>
    <message>
        <source>function %1 instead of %2</source>
        <translation>功能码为 %1，应为 %2</translation>
    </message>
    <message>
        <source>%1 bytes for %2</source>
        <translation>%2 对应 %1 字节</translation>
    </message>
    <message>
        <source>echo of a write differs</source>
        <translation>写入的回显不一致</translation>
    </message>
    <message>
        <source>registers from %1</source>
        <translation>自 %1 起的寄存器</translation>
    </message>
    <message>
        <source>number of registers of %1</source>
        <translation>%1 的寄存器数</translation>
    </message>
    <message>
        <source>the identity register</source>
        <translation>标识寄存器</translation>
    </message>
    <message>
        <source>the version of the register map</source>
        <translation>寄存器映射的版本</translation>
    </message>
    <message>
        <source>the number of temperature sensors</source>
        <translation>温度传感器数</translation>
    </message>
    <message>
        <source>the %1 of the profile</source>
        <translation>配置文件中的 %1</translation>
    </message>
    <message>
        <source>not done within %1 s</source>
        <translation>%1 s 内未完成</translation>
    </message>
    <message>
        <source>an alarm is on</source>
        <translation>存在报警</translation>
    </message>
    <message>
        <source>compensation on</source>
        <translation>接通补偿</translation>
    </message>
    <message>
        <source>compensation off</source>
        <translation>断开补偿</translation>
    </message>
    <message>
        <source>the switch does not follow</source>
        <translation>开关未响应</translation>
    </message>
    <message>
        <source>the offset of axis %1</source>
        <translation>轴 %1 的偏置</translation>
    </message>
    <message>
        <source>not an IPv4 address</source>
        <translation>不是 IPv4 地址</translation>
    </message>
    <message>
        <source>measuring with probes</source>
        <translation>用测头测量</translation>
    </message>
    <message>
        <source>the nose is not at the probe nest</source>
        <translation>主轴端部不在测头座处</translation>
    </message>
    <message>
        <source>a number above 0, at most 100000</source>
        <translation>大于 0 且不超过 100000 的数值</translation>
    </message>
    <message>
        <source>x, y, width and height in pixels</source>
        <translation>以像素表示的 x、y、宽度和高度</translation>
    </message>
    <message>
        <source>%1 axes</source>
        <translation>%1 个轴</translation>
    </message>
    <message>
        <source>two axes, right and up in the image</source>
        <translation>两个轴：图像中向右和向上</translation>
    </message>
    <message>
        <source>a sensor number of the controller&apos;s table</source>
        <translation>控制器表中的传感器编号</translation>
    </message>
    <message>
        <source>0 to %1</source>
        <translation>0 至 %1</translation>
    </message>
    <message>
        <source>data type</source>
        <translation>数据类型</translation>
    </message>
    <message>
        <source>no value</source>
        <translation>没有值</translation>
    </message>
    <message>
        <source>word order</source>
        <translation>字序</translation>
    </message>
    <message>
        <source>byte order</source>
        <translation>字节序</translation>
    </message>
    <message>
        <source>holding register</source>
        <translation>保持寄存器</translation>
    </message>
    <message>
        <source>input register</source>
        <translation>输入寄存器</translation>
    </message>
    <message>
        <source>high first</source>
        <translation>高位在前</translation>
    </message>
    <message>
        <source>big endian</source>
        <translation>大端</translation>
    </message>
    <message>
        <source>low first</source>
        <translation>低位在前</translation>
    </message>
    <message>
        <source>little endian</source>
        <translation>小端</translation>
    </message>
    <message>
        <source>holding or input</source>
        <translation>holding 或 input</translation>
    </message>
    <message>
        <source>int16, uint16, int32, uint32 or float32</source>
        <translation>int16、uint16、int32、uint32 或 float32</translation>
    </message>
    <message>
        <source>high_first or low_first</source>
        <translation>high_first 或 low_first</translation>
    </message>
    <message>
        <source>%1, line %2, %3</source>
        <translation>%1，第 %2 行，%3</translation>
    </message>
    <message>
        <source>a whole number of 0 or more</source>
        <translation>0 或更大的整数</translation>
    </message>
    <message>
        <source>name,address and, as needed, function,type,count,scale,sign,missing,word_order,byte_order</source>
        <translation>name,address，以及按需的 function,type,count,scale,sign,missing,word_order,byte_order</translation>
    </message>
    <message>
        <source>%1, line %2</source>
        <translation>%1，第 %2 行</translation>
    </message>
    <message>
        <source>%1, address of %2</source>
        <translation>%1，%2 的地址</translation>
    </message>
    <message>
        <source>%1, next to the one before</source>
        <translation>%1，紧接前一个</translation>
    </message>
    <message>
        <source>%1, a second time</source>
        <translation>%1，重复出现</translation>
    </message>
    <message>
        <source>a name of its own for each register</source>
        <translation>每个寄存器使用各自的名称</translation>
    </message>
    <message>
        <source>%1: no use is known for %2; give them one of the names of docs/register-maps.md</source>
        <translation>%1：%2 的用途未知；请使用 docs/register-maps.md 中的名称</translation>
    </message>
    <message>
        <source>registers up to 65535</source>
        <translation>寄存器号不超过 65535</translation>
    </message>
    <message>
        <source>the value for register %1</source>
        <translation>寄存器 %1 的值</translation>
    </message>
    <message>
        <source>identity: fixed number</source>
        <translation>标识：固定数值</translation>
    </message>
    <message>
        <source>version of the map</source>
        <translation>映射的版本</translation>
    </message>
    <message>
        <source>bits: what the controller can do</source>
        <translation>位：控制器具备的功能</translation>
    </message>
    <message>
        <source>registers a table may have</source>
        <translation>补偿表可用的寄存器数</translation>
    </message>
    <message>
        <source>controller&apos;s clock, s</source>
        <translation>控制器时钟，s</translation>
    </message>
    <message>
        <source>clock against real time</source>
        <translation>时钟与实际时间之比</translation>
    </message>
    <message>
        <source>our heartbeat</source>
        <translation>本机心跳</translation>
    </message>
    <message>
        <source>bits: 0 cycle, 1 moving, 2 referenced, 3 alarm</source>
        <translation>位：0 循环，1 运动中，2 已回参考点，3 报警</translation>
    </message>
    <message>
        <source>compensation switch, 0 or 1</source>
        <translation>补偿开关，0 或 1</translation>
    </message>
    <message>
        <source>coolant, 0 or 1</source>
        <translation>冷却液，0 或 1</translation>
    </message>
    <message>
        <source>spindle speed, rpm</source>
        <translation>主轴转速，r/min</translation>
    </message>
    <message>
        <source>spindle load, W</source>
        <translation>主轴负载，W</translation>
    </message>
    <message>
        <source>compensation applied now, X Y Z, um</source>
        <translation>当前施加的补偿 X Y Z，µm</translation>
    </message>
    <message>
        <source>wanted position X Y Z, mm</source>
        <translation>目标位置 X Y Z，mm</translation>
    </message>
    <message>
        <source>1 starts the move</source>
        <translation>1 启动移动</translation>
    </message>
    <message>
        <source>wanted speed, rpm</source>
        <translation>目标转速，r/min</translation>
    </message>
    <message>
        <source>wanted coolant</source>
        <translation>要求的冷却液状态</translation>
    </message>
    <message>
        <source>warm-up cycle on</source>
        <translation>暖机循环开启</translation>
    </message>
    <message>
        <source>wanted switch</source>
        <translation>要求的开关状态</translation>
    </message>
    <message>
        <source>room temperature, C</source>
        <translation>室温，°C</translation>
    </message>
    <message>
        <source>temperatures, C, in the profile&apos;s order</source>
        <translation>温度，°C，按配置文件的顺序</translation>
    </message>
    <message>
        <source>probes measure, 0 or 1</source>
        <translation>测头测量，0 或 1</translation>
    </message>
    <message>
        <source>host offset X Y Z (-error), um</source>
        <translation>上位机偏置 X Y Z（-误差），µm</translation>
    </message>
    <message>
        <source>watchdog of the offset, s</source>
        <translation>偏置的看门狗，s</translation>
    </message>
    <message>
        <source>state of the host offset</source>
        <translation>上位机偏置的状态</translation>
    </message>
    <message>
        <source>registers of the staged table</source>
        <translation>暂存表的寄存器数</translation>
    </message>
    <message>
        <source>scale of the staged table</source>
        <translation>暂存表的比例</translation>
    </message>
    <message>
        <source>CRC-32 of the staged table</source>
        <translation>暂存表的 CRC-32</translation>
    </message>
    <message>
        <source>number of the staged table</source>
        <translation>暂存表的编号</translation>
    </message>
    <message>
        <source>commits that number</source>
        <translation>提交该编号</translation>
    </message>
    <message>
        <source>status of the commit</source>
        <translation>提交的状态</translation>
    </message>
    <message>
        <source>number the status is of</source>
        <translation>该状态对应的编号</translation>
    </message>
    <message>
        <source>CRC-32 of the active table</source>
        <translation>有效表的 CRC-32</translation>
    </message>
    <message>
        <source>registers of the active table</source>
        <translation>有效表的寄存器数</translation>
    </message>
    <message>
        <source>number of the active table</source>
        <translation>有效表的编号</translation>
    </message>
    <message>
        <source>why it was refused</source>
        <translation>拒绝的原因</translation>
    </message>
    <message>
        <source>area a table is staged in</source>
        <translation>补偿表的暂存区</translation>
    </message>
    <message>
        <source>area of the active table</source>
        <translation>有效表的存储区</translation>
    </message>
    <message>
        <source>host offset</source>
        <translation>上位机偏置</translation>
    </message>
    <message>
        <source>former tables of machine %1</source>
        <translation>机床 %1 以前的补偿表</translation>
    </message>
    <message>
        <source>the active table</source>
        <translation>有效表</translation>
    </message>
    <message>
        <source>version %1, not written from here</source>
        <translation>版本 %1，不是由此处写入</translation>
    </message>
    <message>
        <source>too few measurements were accepted</source>
        <translation>被接受的测量太少</translation>
    </message>
    <message>
        <source>one, for the sign check</source>
        <translation>符号检查需要一个</translation>
    </message>
    <message>
        <source>it moves %1 too</source>
        <translation>%1 也发生移动</translation>
    </message>
    <message>
        <source>it moves %1, the wrong axis</source>
        <translation>移动的是 %1，轴不对</translation>
    </message>
    <message>
        <source>the measurement is too uncertain (%1 um) to tell</source>
        <translation>测量不确定度过大（%1 µm），无法判断</translation>
    </message>
    <message>
        <source>nothing moves</source>
        <translation>没有移动</translation>
    </message>
    <message>
        <source>the sign is wrong</source>
        <translation>符号错误</translation>
    </message>
    <message>
        <source>the size is wrong</source>
        <translation>大小错误</translation>
    </message>
    <message>
        <source>the sign check</source>
        <translation>符号检查</translation>
    </message>
    <message>
        <source>the controller takes the test offset out by itself</source>
        <translation>控制器会自行撤销测试偏置</translation>
    </message>
    <message>
        <source>the offset is not applied, or does not come to rest</source>
        <translation>偏置未施加，或未稳定</translation>
    </message>
    <message>
        <source>register words, 0 to 65535</source>
        <translation>寄存器字，0 至 65535</translation>
    </message>
    <message>
        <source>um_per_K of a point of axis %1</source>
        <translation>轴 %1 某点的 um_per_K</translation>
    </message>
    <message>
        <source>0, because the axis has no temperature term</source>
        <translation>0，因为该轴没有温度项</translation>
    </message>
    <message>
        <source>the controller&apos;s table</source>
        <translation>控制器的补偿表</translation>
    </message>
    <message>
        <source>it ends early</source>
        <translation>数据不完整</translation>
    </message>
    <message>
        <source>an axis record of 12 words</source>
        <translation>12 个字的轴记录</translation>
    </message>
    <message>
        <source>axes 0 to 2, each once</source>
        <translation>轴 0 至 2，各一次</translation>
    </message>
    <message>
        <source>all terms and points</source>
        <translation>所有的项和点</translation>
    </message>
    <message>
        <source>the size of the table in registers</source>
        <translation>以寄存器数表示的表大小</translation>
    </message>
    <message>
        <source>at least 2</source>
        <translation>至少 2</translation>
    </message>
    <message>
        <source>format %1</source>
        <translation>格式 %1</translation>
    </message>
    <message>
        <source>format 1</source>
        <translation>格式 1</translation>
    </message>
    <message>
        <source>%1 words too many</source>
        <translation>多出 %1 个字</translation>
    </message>
    <message>
        <source>the end</source>
        <translation>结尾</translation>
    </message>
    <message>
        <source>a valid table</source>
        <translation>有效的补偿表</translation>
    </message>
    <message>
        <source>the check sum does not fit</source>
        <translation>校验和不符</translation>
    </message>
    <message>
        <source>the number of registers is wrong</source>
        <translation>寄存器数错误</translation>
    </message>
    <message>
        <source>the words are not a table</source>
        <translation>数据不是补偿表</translation>
    </message>
    <message>
        <source>a limit of the machine is exceeded</source>
        <translation>超出机床的限值</translation>
    </message>
    <message>
        <source>the compensation switch is on</source>
        <translation>补偿开关已接通</translation>
    </message>
    <message>
        <source>the axes move</source>
        <translation>轴在运动</translation>
    </message>
    <message>
        <source>the scale is wrong</source>
        <translation>比例错误</translation>
    </message>
    <message>
        <source>the sequence number is wrong</source>
        <translation>序号错误</translation>
    </message>
    <message>
        <source>reason %1</source>
        <translation>原因 %1</translation>
    </message>
    <message>
        <source>an upload</source>
        <translation>上传</translation>
    </message>
    <message>
        <source>%1 registers</source>
        <translation>%1 个寄存器</translation>
    </message>
    <message>
        <source>version %1</source>
        <translation>版本 %1</translation>
    </message>
    <message>
        <source>active table</source>
        <translation>有效表</translation>
    </message>
    <message>
        <source>sequence %1</source>
        <translation>序号 %1</translation>
    </message>
    <message>
        <source>the check of the table</source>
        <translation>补偿表的检查</translation>
    </message>
    <message>
        <source>status stays %1</source>
        <translation>状态一直为 %1</translation>
    </message>
    <message>
        <source>dry run: nothing was written</source>
        <translation>试运行：未写入任何内容</translation>
    </message>
    <message>
        <source>a table it computes itself</source>
        <translation>它自行计算的补偿表</translation>
    </message>
    <message>
        <source>%1: the machine is outside the range the model was made in</source>
        <translation>%1：机床超出建模时的范围</translation>
    </message>
    <message>
        <source>the table&apos;s machine</source>
        <translation>补偿表所属的机床</translation>
    </message>
    <message>
        <source>the axes are not referenced</source>
        <translation>各轴未回参考点</translation>
    </message>
    <message>
        <source>the warm-up cycle runs</source>
        <translation>暖机循环正在运行</translation>
    </message>
    <message>
        <source>the change of the compensation of axis %1</source>
        <translation>轴 %1 补偿量的变化</translation>
    </message>
    <message>
        <source>the ramp could not be watched: %1</source>
        <translation>无法监视渐变过程：%1</translation>
    </message>
    <message>
        <source>the ramp stands at %1 %</source>
        <translation>渐变停在 %1 %</translation>
    </message>
    <message>
        <source>the old table was written again</source>
        <translation>旧表已重新写入</translation>
    </message>
    <message>
        <source>the old table is still active</source>
        <translation>旧表仍然有效</translation>
    </message>
    <message>
        <source>the old table</source>
        <translation>旧表</translation>
    </message>
    <message>
        <source>another one</source>
        <translation>另一个</translation>
    </message>
    <message>
        <source>its check sum does not fit</source>
        <translation>其校验和不符</translation>
    </message>
    <message>
        <source>the axis to export (this format holds one axis a file)</source>
        <translation>要导出的轴（该格式每个文件一个轴）</translation>
    </message>
    <message>
        <source>position points of axis %1</source>
        <translation>轴 %1 的位置点</translation>
    </message>
    <message>
        <source>the written file</source>
        <translation>写出的文件</translation>
    </message>
    <message>
        <source>axis %1: the file does not follow temperatures; it holds for %2. Feed the thermal part at run time</source>
        <translation>轴 %1：该文件不随温度变化，适用于 %2；热误差部分请在运行时输入</translation>
    </message>
    <message>
        <source>axis %1: both directions are averaged (they differ by up to %2 um); the mean reversal of %3 um (up - down) belongs into %4</source>
        <translation>轴 %1：两个方向取平均（最多相差 %2 µm）；平均反向差值 %3 µm（上 - 下）应填入 %4</translation>
    </message>
    <message>
        <source>a parameter with axis A1 to A3</source>
        <translation>含轴 A1 至 A3 的参数</translation>
    </message>
    <message>
        <source>parameters 3620 to 3624</source>
        <translation>参数 3620 至 3624</translation>
    </message>
    <message>
        <source>reference point %1</source>
        <translation>参考点 %1</translation>
    </message>
    <message>
        <source>one between lowest and highest</source>
        <translation>介于最低和最高之间</translation>
    </message>
    <message>
        <source>a whole number after P</source>
        <translation>P 之后的整数</translation>
    </message>
    <message>
        <source>finite numbers, positions in order</source>
        <translation>有限的数值，位置按顺序排列</translation>
    </message>
    <message>
        <source>axis %1: an increment of %2 units; older series take no more than 7</source>
        <translation>轴 %1：增量为 %2 个单位；老系列最多为 7</translation>
    </message>
    <message>
        <source>axis %1: the error of %2 um at the reference point shifts the whole axis and is left out</source>
        <translation>轴 %1：参考点处 %2 µm 的误差会使整个轴平移，已略去</translation>
    </message>
    <message>
        <source>axis %1: points up to %2; many controls end at 1023</source>
        <translation>轴 %1：点号达 %2；许多控制器止于 1023</translation>
    </message>
    <message>
        <source>the backlash parameter 1851</source>
        <translation>反向间隙参数 1851</translation>
    </message>
    <message>
        <source>axes with position points</source>
        <translation>有位置点的轴</translation>
    </message>
    <message>
        <source>the sign, with a single point of +1 unit before the rest</source>
        <translation>符号：先用一个 +1 单位的点确认，再写入其余的点</translation>
    </message>
    <message>
        <source>axes X, Y, Z are numbers 1, 2, 3; the parameter lines (Q1) and the G10 form on this series</source>
        <translation>轴 X、Y、Z 编号为 1、2、3；以及该系列的参数行（Q1）和 G10 格式</translation>
    </message>
    <message>
        <source>increments of -error per interval</source>
        <translation>每个间隔的 -误差 增量</translation>
    </message>
    <message>
        <source>the export format</source>
        <translation>导出格式</translation>
    </message>
    <message>
        <source>two rows or more</source>
        <translation>两行或更多</translation>
    </message>
    <message>
        <source>axis %1: %2 points are resampled to %3</source>
        <translation>轴 %1：%2 个点重新采样为 %3 个</translation>
    </message>
    <message>
        <source>axis %1: values and positions are rounded to 0.0001 mm</source>
        <translation>轴 %1：数值和位置圆整到 0.0001 mm</translation>
    </message>
    <message>
        <source>the sign (+error), and the form of the .CMA file on this control</source>
        <translation>符号（+误差），以及该控制器 .CMA 文件的格式</translation>
    </message>
    <message>
        <source>lines of three numbers</source>
        <translation>每行三个数值</translation>
    </message>
    <message>
        <source>type 0: actual position = nominal + error; type 1: trim = -error</source>
        <translation>type 0：实际位置 = 名义值 + 误差；type 1：trim = -误差</translation>
    </message>
    <message>
        <source>axis %1 must move by %2 um, everywhere alike, when this file takes effect</source>
        <translation>该文件生效时，轴 %1 在各处都必须移动 %2 µm</translation>
    </message>
    <message>
        <source>at %1 mm axis %2 must move by %3 um when this file takes effect, and nowhere else</source>
        <translation>该文件生效时，轴 %2 在 %1 mm 处必须移动 %3 µm，其他位置不动</translation>
    </message>
    <message>
        <source>values and an axis</source>
        <translation>数值和轴</translation>
    </message>
    <message>
        <source>points from 0</source>
        <translation>从 0 开始的点</translation>
    </message>
    <message>
        <source>axis names X1, Y1, Z1; compensation works after power-on, homing and MD32700 = 1</source>
        <translation>轴名称 X1、Y1、Z1；补偿在上电、回参考点且 MD32700 = 1 后生效</translation>
    </message>
    <message>
        <source>the sign of CEC tables</source>
        <translation>CEC 表的符号</translation>
    </message>
    <message>
        <source>+error (a positive value moves the axis in the negative direction)</source>
        <translation>+误差（正值使轴向负方向移动）</translation>
    </message>
    <message>
        <source>numbers and temperatures of the R parameters</source>
        <translation>R 参数的编号和温度</translation>
    </message>
    <message>
        <source>axis %1: the position points (up to %2 um) do not fit into a straight line; export sinumerik-leadscrew beside</source>
        <translation>轴 %1：位置点（最大 %2 µm）无法用一条直线表示；请另行导出 sinumerik-leadscrew</translation>
    </message>
    <message>
        <source>the sign (written +error by inference: the value acts on the actual position)</source>
        <translation>符号（推断写为 +误差：该值作用于实际位置）</translation>
    </message>
    <message>
        <source>axis names X1, Y1, Z1, and that the PLC writes the temperatures into the R parameters named</source>
        <translation>轴名称 X1、Y1、Z1，以及 PLC 将温度写入指定的 R 参数</translation>
    </message>
    <message>
        <source>+error (acts on the actual value)</source>
        <translation>+误差（作用于实际值）</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>high_first</source>
        <translation>高位在前</translation>
    </message>
    <message>
        <source>interlock</source>
        <translation>联锁</translation>
    </message>
    <message>
        <source>temperatures</source>
        <translation>温度采集</translation>
    </message>
    <message>
        <source>table</source>
        <translation>补偿表</translation>
    </message>
    <message>
        <source>a refused table</source>
        <translation>补偿表被拒绝</translation>
    </message>
    <message>
        <source>%1; the mean reversal of %2 um (up - down) belongs into %3</source>
        <translation>%1；平均反向差值 %2 µm（上 - 下）应填入 %3</translation>
    </message>
    <message>
        <source>on</source>
        <translation>接通</translation>
    </message>
    <message>
        <source>off</source>
        <translation>断开</translation>
    </message>
    <message>
        <source>the name of a register</source>
        <translation>寄存器名称</translation>
    </message>
    <message>
        <source>a name of its own</source>
        <translation>唯一的名称</translation>
    </message>
    <message>
        <source>one, for the test move</source>
        <translation>一个，用于测试移动</translation>
    </message>
    <message>
        <source>at least %1 pixels</source>
        <translation>至少 %1 像素</translation>
    </message>
    <message>
        <source>no folder can be made there</source>
        <translation>无法在该处创建文件夹</translation>
    </message>
    <message>
        <source>OK</source>
        <translation>正常</translation>
    </message>
    <message>
        <source>a step of the flow</source>
        <translation>流程中的某一步</translation>
    </message>
    <message>
        <source>%1 (serial %2)</source>
        <translation>%1（序列号 %2）</translation>
    </message>
    <message>
        <source>axis of a camera</source>
        <translation>相机对应的轴</translation>
    </message>
    <message>
        <source>calibration of %1</source>
        <translation>%1 的标定</translation>
    </message>
    <message>
        <source>calibration of camera %1</source>
        <translation>相机 %1 的标定</translation>
    </message>
    <message>
        <source>Method %1 on %2 sensors: leaves at most %3 um (rms %4 um) on data it has not seen (%5).</source>
        <translation>方法 %1，%2 个传感器：对未参与拟合的数据，最大残余误差 %3 µm（rms %4 µm；%5）。</translation>
    </message>
    <message>
        <source>%1 A dynamic model, which needs the host compensator, would leave %2 um rms.</source>
        <translation>%1 动态模型需要上位机补偿器，可将残余误差降至 rms %2 µm。</translation>
    </message>
    <message>
        <source>the job&apos;s model</source>
        <translation>作业中的模型</translation>
    </message>
    <message>
        <source>the job&apos;s profile</source>
        <translation>作业中的配置文件</translation>
    </message>
    <message>
        <source>sensor %1</source>
        <translation>传感器 %1</translation>
    </message>
    <message>
        <source>link: %1 %2 times, overcome</source>
        <translation>链路：%1 出现 %2 次，已恢复</translation>
    </message>
    <message>
        <source>%1 offset</source>
        <translation>%1 偏置</translation>
    </message>
    <message>
        <source>%1 um</source>
        <translation>%1 µm</translation>
    </message>
    <message>
        <source>%1 um/K from %2 C</source>
        <translation>%1 µm/K，自 %2 °C 起</translation>
    </message>
    <message>
        <source>%1 points</source>
        <translation>%1 个点</translation>
    </message>
    <message>
        <source>checking the sign</source>
        <translation>检查符号</translation>
    </message>
    <message>
        <source>test offset</source>
        <translation>测试偏置</translation>
    </message>
    <message>
        <source>host offset of X, Y, Z, one after the other</source>
        <translation>依次对 X、Y、Z 施加上位机偏置</translation>
    </message>
    <message>
        <source>10 um, then 0 um</source>
        <translation>先 10 µm，再归 0 µm</translation>
    </message>
    <message>
        <source>the axis table</source>
        <translation>轴补偿表</translation>
    </message>
    <message>
        <source>Writing the table</source>
        <translation>正在写入补偿表</translation>
    </message>
    <message>
        <source>upload table</source>
        <translation>上传补偿表</translation>
    </message>
    <message>
        <source>compensation table</source>
        <translation>补偿表</translation>
    </message>
    <message>
        <source>version %1, %2 registers</source>
        <translation>版本 %1，%2 个寄存器</translation>
    </message>
    <message>
        <source>the uploaded table</source>
        <translation>已上传的补偿表</translation>
    </message>
    <message>
        <source>the warm-up&apos;s plan</source>
        <translation>暖机计划</translation>
    </message>
    <message>
        <source>the corrected table</source>
        <translation>修正后的补偿表</translation>
    </message>
    <message>
        <source>%1, %2 times</source>
        <translation>%1，%2 次</translation>
    </message>
    <message>
        <source>link: %1, %2 times, overcome</source>
        <translation>链路：%1，%2 次，已恢复</translation>
    </message>
    <message>
        <source>axes are not referenced</source>
        <translation>各轴未回参考点</translation>
    </message>
    <message>
        <source>temperature sensors</source>
        <translation>温度传感器</translation>
    </message>
    <message>
        <source>a time from 0.05 to 3600 s</source>
        <translation>0.05 至 3600 s 的时间</translation>
    </message>
    <message>
        <source>a time from 0.05 to 86400 s</source>
        <translation>0.05 至 86400 s 的时间</translation>
    </message>
    <message>
        <source>a time above 0, at most 14 days, in s</source>
        <translation>大于 0 且不超过 14 天的时间（单位 s）</translation>
    </message>
    <message>
        <source>a speed from 0 to 200000 rpm</source>
        <translation>0 至 200000 r/min 的转速</translation>
    </message>
    <message>
        <source>a position in mm</source>
        <translation>以 mm 表示的位置</translation>
    </message>
    <message>
        <source>at least sample_period_s</source>
        <translation>不小于 sample_period_s</translation>
    </message>
    <message>
        <source>one of X, Y, Z</source>
        <translation>X、Y、Z 之一</translation>
    </message>
    <message>
        <source>an empty list</source>
        <translation>空列表</translation>
    </message>
    <message>
        <source>at least one step</source>
        <translation>至少一个步骤</translation>
    </message>
    <message>
        <source>Warm-up, 4 h, stepped speeds</source>
        <translation>暖机 4 h，阶梯转速</translation>
    </message>
    <message>
        <source>Warm-up, 4 h at 3000 rpm</source>
        <translation>暖机 4 h，3000 r/min</translation>
    </message>
    <message>
        <source>Warm-up and cooling, 3000 rpm</source>
        <translation>暖机与冷却，3000 r/min</translation>
    </message>
    <message>
        <source>Stepped speed spectrum</source>
        <translation>阶梯转速谱</translation>
    </message>
    <message>
        <source>ISO 230-3 environment (ETVE), 24 h</source>
        <translation>ISO 230-3 环境温度变化误差（ETVE），24 h</translation>
    </message>
    <message>
        <source>ISO 230-3 spindle, constant speed</source>
        <translation>ISO 230-3 主轴，恒定转速</translation>
    </message>
    <message>
        <source>ISO 230-3 spindle, varying speed</source>
        <translation>ISO 230-3 主轴，变转速</translation>
    </message>
    <message>
        <source>ISO 230-3 linear axes</source>
        <translation>ISO 230-3 直线轴</translation>
    </message>
    <message>
        <source>Short check, 30 min at 3000 rpm</source>
        <translation>快速检查，3000 r/min，30 min</translation>
    </message>
    <message>
        <source>machine clock</source>
        <translation>机床时钟</translation>
    </message>
    <message>
        <source>stands still</source>
        <translation>停止不动</translation>
    </message>
    <message>
        <source>its zero cannot be restored</source>
        <translation>无法恢复其零点</translation>
    </message>
    <message>
        <source>serial number</source>
        <translation>序列号</translation>
    </message>
    <message>
        <source>channels of the machine</source>
        <translation>机床的通道</translation>
    </message>
    <message>
        <source>the %1 of the run</source>
        <translation>该运行的 %1</translation>
    </message>
    <message>
        <source>binary data</source>
        <translation>二进制数据</translation>
    </message>
    <message>
        <source>a CSV text table</source>
        <translation>CSV 文本表格</translation>
    </message>
    <message>
        <source>%1(no name)</source>
        <translation>%1（无名称）</translation>
    </message>
    <message>
        <source>%1 (a second time)</source>
        <translation>%1（重复出现）</translation>
    </message>
    <message>
        <source>a name of its own for each column</source>
        <translation>每一列使用各自的名称</translation>
    </message>
    <message>
        <source>a position is not a number</source>
        <translation>位置不是数值</translation>
    </message>
    <message>
        <source>the two positions are %1 px apart in the image, at least %2 px are needed</source>
        <translation>两个位置在图像中相距 %1 px，至少需要 %2 px</translation>
    </message>
    <message>
        <source>all positions have the same machine coordinates</source>
        <translation>所有位置的机床坐标都相同</translation>
    </message>
    <message>
        <source>the positions span only %1 px in the image, at least %2 px are needed</source>
        <translation>各位置在图像中仅跨越 %1 px，至少需要 %2 px</translation>
    </message>
    <message>
        <source>the positions lie on one line: move along both axes</source>
        <translation>各位置在一条直线上：请沿两个轴移动</translation>
    </message>
    <message>
        <source>the positions span only %1 px in one direction, at least %2 px are needed</source>
        <translation>各位置在一个方向上仅跨越 %1 px，至少需要 %2 px</translation>
    </message>
    <message>
        <source>the scale differs by %1 % between two directions: the camera looks at the plane of motion from the side</source>
        <translation>两个方向的比例相差 %1 %：相机斜视运动平面</translation>
    </message>
    <message>
        <source>the calibration</source>
        <translation>标定</translation>
    </message>
    <message>
        <source>%1 of the views can be used: 2 are needed, 9 are better</source>
        <translation>可用的视图为 %1 个：至少需要 2 个，最好 9 个</translation>
    </message>
    <message>
        <source>2, better 9</source>
        <translation>2 个，最好 9 个</translation>
    </message>
    <message>
        <source>the residual is %1 um rms, the limit %2 um</source>
        <translation>残差 rms 为 %1 µm，限值为 %2 µm</translation>
    </message>
    <message>
        <source>%1; the view that fits worst is %2 (%3 um off)</source>
        <translation>%1；拟合最差的视图是 %2（偏差 %3 µm）</translation>
    </message>
    <message>
        <source>two positions cannot show a mirrored camera; the image was taken as not mirrored: add a third position beside the line of the two</source>
        <translation>两个位置无法判断图像是否镜像；已按非镜像处理：请在两点连线之外增加第三个位置</translation>
    </message>
    <message>
        <source>%1 does not fit the other views: it is %2 um off where they agree to %3 um; check its position, or leave it out</source>
        <translation>%1 与其他图像不符：偏差 %2 µm，而其他图像彼此相差仅 %3 µm；请检查其位置，或将其去掉</translation>
    </message>
    <message>
        <source>the reference mark %1</source>
        <translation>参考标记 %1</translation>
    </message>
    <message>
        <source>three positions leave nothing to check the calibration with: use nine</source>
        <translation>三个位置没有多余数据用于检验标定：请使用九个位置</translation>
    </message>
    <message>
        <source>a 2x2 matrix as two rows of two numbers</source>
        <translation>由两行、每行两个数值组成的 2×2 矩阵</translation>
    </message>
    <message>
        <source>not finite</source>
        <translation>不是有限值</translation>
    </message>
    <message>
        <source>finite numbers</source>
        <translation>有限的数值</translation>
    </message>
    <message>
        <source>a matrix that can be inverted</source>
        <translation>可逆矩阵</translation>
    </message>
    <message>
        <source>not a 4x4 matrix</source>
        <translation>不是 4×4 矩阵</translation>
    </message>
    <message>
        <source>four rows of four numbers</source>
        <translation>四行、每行四个数值</translation>
    </message>
    <message>
        <source>position %1, %2 mm</source>
        <translation>位置 %1，%2 mm</translation>
    </message>
    <message>
        <source>not opened yet</source>
        <translation>尚未打开</translation>
    </message>
    <message>
        <source>the stream ended</source>
        <translation>数据流已结束</translation>
    </message>
    <message>
        <source>no picture could be opened</source>
        <translation>无法打开任何图像</translation>
    </message>
    <message>
        <source>camera does not answer</source>
        <translation>相机无应答</translation>
    </message>
    <message>
        <source>a folder without pictures</source>
        <translation>不含图像的文件夹</translation>
    </message>
    <message>
        <source>a folder of PNG, JPEG, BMP or TIFF pictures</source>
        <translation>含 PNG、JPEG、BMP 或 TIFF 图像的文件夹</translation>
    </message>
    <message>
        <source>camera sends no picture</source>
        <translation>相机不发送图像</translation>
    </message>
    <message>
        <source>camera is frozen</source>
        <translation>相机画面冻结</translation>
    </message>
    <message>
        <source>the stored zero</source>
        <translation>已存储的零点</translation>
    </message>
    <message>
        <source>%1 views</source>
        <translation>%1 个视图</translation>
    </message>
    <message>
        <source>no frame</source>
        <translation>没有图像</translation>
    </message>
    <message>
        <source>the file is empty</source>
        <translation>文件为空</translation>
    </message>
    <message>
        <source>the PNG file ends early</source>
        <translation>PNG 文件不完整</translation>
    </message>
    <message>
        <source>the picture is larger than 100 megapixels</source>
        <translation>图像大于 1 亿像素</translation>
    </message>
    <message>
        <source>the JPEG file ends early</source>
        <translation>JPEG 文件不完整</translation>
    </message>
    <message>
        <source>the BMP file ends early</source>
        <translation>BMP 文件不完整</translation>
    </message>
    <message>
        <source>not a PNG, JPEG, BMP or TIFF picture</source>
        <translation>不是 PNG、JPEG、BMP 或 TIFF 图像</translation>
    </message>
    <message>
        <source>16 bits reduced to 8</source>
        <translation>16 位已转换为 8 位</translation>
    </message>
    <message>
        <source>pixels are neither 8 nor 16 bits</source>
        <translation>像素既不是 8 位也不是 16 位</translation>
    </message>
    <message>
        <source>colour reduced to luminance</source>
        <translation>彩色已转换为亮度</translation>
    </message>
    <message>
        <source>%1, colour to luminance</source>
        <translation>%1，彩色已转换为亮度</translation>
    </message>
    <message>
        <source>neither grey nor colour</source>
        <translation>既不是灰度也不是彩色</translation>
    </message>
    <message>
        <source>an empty image was to be encoded</source>
        <translation>要编码的图像为空</translation>
    </message>
    <message>
        <source>the encoder for %1</source>
        <translation>%1 的编码器</translation>
    </message>
    <message>
        <source>%1 failed</source>
        <translation>%1 失败</translation>
    </message>
    <message>
        <source>the picture is damaged</source>
        <translation>图像已损坏</translation>
    </message>
    <message>
        <source>%1 is a folder, no picture, and was left out</source>
        <translation>%1 是文件夹，不是图像，已略去</translation>
    </message>
    <message>
        <source>%1 is no PNG, JPEG, BMP or TIFF picture and was left out</source>
        <translation>%1 不是 PNG、JPEG、BMP 或 TIFF 图像，已略去</translation>
    </message>
    <message>
        <source>%1 was left out: %2</source>
        <translation>%1 已略去：%2</translation>
    </message>
    <message>
        <source>no region was given: %1,%2,%3,%4 shows the most pattern and is used, measured is the point %5, %6</source>
        <translation>未指定区域：%1,%2,%3,%4 处纹理最丰富，予以采用；测量点为 %5, %6</translation>
    </message>
    <message>
        <source>the target (no region was given)</source>
        <translation>靶标（未指定区域）</translation>
    </message>
    <message>
        <source>%1 stands still while %2 moves by up to %3 px</source>
        <translation>%1 静止不动，而 %2 最多移动了 %3 px</translation>
    </message>
    <message>
        <source>the region of one of them</source>
        <translation>两者之一的区域</translation>
    </message>
    <message>
        <source>%1: %2x%3 pixels, the template has %4x%5</source>
        <translation>%1：%2×%3 像素，模板为 %4×%5</translation>
    </message>
    <message>
        <source>target missing</source>
        <translation>未找到靶标</translation>
    </message>
    <message>
        <source>target occluded, or another one</source>
        <translation>靶标被遮挡，或为另一靶标</translation>
    </message>
    <message>
        <source>target occluded</source>
        <translation>靶标被遮挡</translation>
    </message>
    <message>
        <source>too blurred</source>
        <translation>图像模糊</translation>
    </message>
    <message>
        <source>target out of view</source>
        <translation>靶标超出视场</translation>
    </message>
    <message>
        <source>too little light or contrast</source>
        <translation>光线或对比度不足</translation>
    </message>
    <message>
        <source>too different from the template</source>
        <translation>与模板差异过大</translation>
    </message>
    <message>
        <source>another resolution than the template</source>
        <translation>分辨率与模板不同</translation>
    </message>
    <message>
        <source>the region of the target</source>
        <translation>靶标区域</translation>
    </message>
    <message>
        <source>%1x%2 pixels</source>
        <translation>%1×%2 像素</translation>
    </message>
    <message>
        <source>at least %1x%2</source>
        <translation>至少 %1×%2</translation>
    </message>
    <message>
        <source>the named point</source>
        <translation>指定的点</translation>
    </message>
    <message>
        <source>not a place</source>
        <translation>不是位置</translation>
    </message>
    <message>
        <source>X,Y in pixels</source>
        <translation>以像素表示的 X,Y</translation>
    </message>
    <message>
        <source>Room</source>
        <translation>室温</translation>
    </message>
    <message>
        <source>Spindle speed</source>
        <translation>主轴转速</translation>
    </message>
    <message>
        <source>Spindle load</source>
        <translation>主轴负载</translation>
    </message>
    <message>
        <source>Coolant</source>
        <translation>冷却液</translation>
    </message>
    <message>
        <source>front</source>
        <translation>前方</translation>
    </message>
    <message>
        <source>side</source>
        <translation>侧方</translation>
    </message>
    <message>
        <source>Spindle front bearing</source>
        <translation>主轴前轴承</translation>
    </message>
    <message>
        <source>Spindle between front bearing and motor</source>
        <translation>主轴前轴承与电机之间</translation>
    </message>
    <message>
        <source>Spindle motor, front end</source>
        <translation>主轴电机前端</translation>
    </message>
    <message>
        <source>Spindle motor, rear end</source>
        <translation>主轴电机后端</translation>
    </message>
    <message>
        <source>Spindle rear bearing</source>
        <translation>主轴后轴承</translation>
    </message>
    <message>
        <source>Spindle nose</source>
        <translation>主轴端部</translation>
    </message>
    <message>
        <source>Headstock</source>
        <translation>主轴箱</translation>
    </message>
    <message>
        <source>Column front, top</source>
        <translation>立柱前侧上部</translation>
    </message>
    <message>
        <source>Column rear, top</source>
        <translation>立柱后侧上部</translation>
    </message>
    <message>
        <source>X screw nut</source>
        <translation>X 轴丝杠螺母</translation>
    </message>
    <message>
        <source>X screw support bearing</source>
        <translation>X 轴丝杠支承轴承</translation>
    </message>
    <message>
        <source>Y screw nut</source>
        <translation>Y 轴丝杠螺母</translation>
    </message>
    <message>
        <source>Y screw support bearing</source>
        <translation>Y 轴丝杠支承轴承</translation>
    </message>
    <message>
        <source>Z screw nut</source>
        <translation>Z 轴丝杠螺母</translation>
    </message>
    <message>
        <source>Z screw support bearing</source>
        <translation>Z 轴丝杠支承轴承</translation>
    </message>
    <message>
        <source>X guide</source>
        <translation>X 轴导轨</translation>
    </message>
    <message>
        <source>A trunnion drive</source>
        <translation>A 轴摇篮驱动</translation>
    </message>
    <message>
        <source>C table drive</source>
        <translation>C 轴转台驱动</translation>
    </message>
    <message>
        <source>Table</source>
        <translation>工作台</translation>
    </message>
    <message>
        <source>Bed</source>
        <translation>床身</translation>
    </message>
    <message>
        <source>Coolant tank</source>
        <translation>冷却液箱</translation>
    </message>
    <message>
        <source>a connected machine</source>
        <translation>已连接的机床</translation>
    </message>
    <message>
        <source>a job</source>
        <translation>一个作业</translation>
    </message>
    <message>
        <source>a connection profile</source>
        <translation>连接配置文件</translation>
    </message>
    <message>
        <source>%1 is still running</source>
        <translation>“%1”仍在进行</translation>
    </message>
    <message>
        <source>measuring model data (compensation %1)</source>
        <translation>测量建模数据（补偿 %1）</translation>
    </message>
    <message>
        <source>sign %1</source>
        <translation>符号 %1</translation>
    </message>
    <message>
        <source>near heat</source>
        <translation>近端热量</translation>
    </message>
    <message>
        <source>a length in mm, 2 to 30000 (is it in metres?)</source>
        <translation>以 mm 表示的长度，2 至 30000（是否误用了 m？）</translation>
    </message>
    <message>
        <source>a diameter in mm, 1 to 5000 (is it in metres?)</source>
        <translation>以 mm 表示的直径，1 至 5000（是否误用了 m？）</translation>
    </message>
    <message>
        <source>a diameter in mm, 0 to 5000</source>
        <translation>以 mm 表示的直径，0 至 5000</translation>
    </message>
    <message>
        <source>a place in mm from the fixed end</source>
        <translation>距固定端的位置（mm）</translation>
    </message>
    <message>
        <source>W/(m K), 0.1 to 2500 (steel has about 45)</source>
        <translation>W/(m·K)，0.1 至 2500（钢约为 45）</translation>
    </message>
    <message>
        <source>kg/m3, 100 to 25000 (steel has 7850)</source>
        <translation>kg/m³，100 至 25000（钢为 7850）</translation>
    </message>
    <message>
        <source>J/(kg K), 50 to 12000 (steel has about 460)</source>
        <translation>J/(kg·K)，50 至 12000（钢约为 460）</translation>
    </message>
    <message>
        <source>1/K, up to 5e-4 (steel has 1.15e-5)</source>
        <translation>1/K，不超过 5e-4（钢为 1.15e-5）</translation>
    </message>
    <message>
        <source>degrees Celsius, -60 to 200 (is it in kelvin?)</source>
        <translation>摄氏度，-60 至 200（是否误用了 K？）</translation>
    </message>
    <message>
        <source>watts, 10 to 2000000 (is it in kW?)</source>
        <translation>瓦，10 至 2000000（是否误用了 kW？）</translation>
    </message>
    <message>
        <source>a share from 0.05 to 1</source>
        <translation>0.05 至 1 之间的比例</translation>
    </message>
    <message>
        <source>rpm, 10 to 500000</source>
        <translation>r/min，10 至 500000</translation>
    </message>
    <message>
        <source>kelvin, above 0 and up to 20</source>
        <translation>K，大于 0 且不超过 20</translation>
    </message>
    <message>
        <source>a share above 0 and up to 5, for example 0.1 for 10 %</source>
        <translation>大于 0、至多为 5 的比例，例如 0.1 即 10 %</translation>
    </message>
    <message>
        <source>a list of on, n, n2</source>
        <translation>由 on、n、n2 组成的列表</translation>
    </message>
    <message>
        <source>a friction factor from 0 to 0.5 (usual 0.0003 to 0.002)</source>
        <translation>0 至 0.5 的摩擦因数（通常 0.0003 至 0.002）</translation>
    </message>
    <message>
        <source>mm2/s, 0.5 to 20000</source>
        <translation>mm²/s，0.5 至 20000</translation>
    </message>
    <message>
        <source>a place inside the component, 0 to %1 mm</source>
        <translation>部件内的位置，0 至 %1 mm</translation>
    </message>
    <message>
        <source>more than from_mm (%1)</source>
        <translation>大于 from_mm（%1）</translation>
    </message>
    <message>
        <source>a share from 0 to 1</source>
        <translation>0 至 1 之间的比例</translation>
    </message>
    <message>
        <source>a share of the section, 0.01 to 0.99</source>
        <translation>截面的比例，0.01 至 0.99</translation>
    </message>
    <message>
        <source>less than outer_diameter_mm (%1)</source>
        <translation>小于 outer_diameter_mm（%1）</translation>
    </message>
    <message>
        <source>the id of a component</source>
        <translation>某个部件的标识</translation>
    </message>
    <message>
        <source>a place inside %1, 0 to %2 mm</source>
        <translation>%1 内的位置，0 至 %2 mm</translation>
    </message>
    <message>
        <source>a channel named only once</source>
        <translation>只命名一次的通道</translation>
    </message>
    <message>
        <source>one of %1</source>
        <translation>%1 之一</translation>
    </message>
    <message>
        <source>something else</source>
        <translation>其他内容</translation>
    </message>
    <message>
        <source>an object with one entry an effect</source>
        <translation>每种效应一个条目的对象</translation>
    </message>
    <message>
        <source>an object of numbers</source>
        <translation>由数值组成的对象</translation>
    </message>
    <message>
        <source>a number, since the effect is listed</source>
        <translation>一个数值，因为该效应已列出</translation>
    </message>
    <message>
        <source>an id used only once</source>
        <translation>只使用一次的标识</translation>
    </message>
    <message>
        <source>%1 ends</source>
        <translation>%1 个端点</translation>
    </message>
    <message>
        <source>two ends</source>
        <translation>两个端点</translation>
    </message>
    <message>
        <source>no rod</source>
        <translation>没有杆件</translation>
    </message>
    <message>
        <source>a component with length and diameter to place a sensor on</source>
        <translation>有长度和直径、可布置传感器的部件</translation>
    </message>
    <message>
        <source>the displacements of %1</source>
        <translation>%1 的位移</translation>
    </message>
    <message>
        <source>%1 against the simulated temperatures</source>
        <translation>%1，与仿真温度相对</translation>
    </message>
    <message>
        <source>%1 has no channel %2</source>
        <translation>%1 中没有通道 %2</translation>
    </message>
    <message>
        <source>%1, channel %2</source>
        <translation>%1，通道 %2</translation>
    </message>
    <message>
        <source>%1 as its middle value</source>
        <translation>中值为 %1</translation>
    </message>
    <message>
        <source>degrees Celsius (is it in kelvin or millidegrees?)</source>
        <translation>摄氏度（是否误用了 K 或毫度？）</translation>
    </message>
    <message>
        <source>the simulation left all bounds</source>
        <translation>仿真结果发散</translation>
    </message>
    <message>
        <source>Bearings are simulated too cold - with less load than described, too hot - more so the warmer or the faster they run</source>
        <translation>轴承的仿真温度偏低（载荷小于描述值时偏高），温度越高、转速越快，偏差越大</translation>
    </message>
    <message>
        <source>Bearings are simulated too cold in the first hours only, whatever the temperature is later</source>
        <translation>仅在最初几小时轴承的仿真温度偏低，与之后的温度无关</translation>
    </message>
    <message>
        <source>Bearings are simulated too cold at first and too hot later; friction falls as the oil warms</source>
        <translation>轴承的仿真温度先偏低、后偏高；润滑油变热后摩擦减小</translation>
    </message>
    <message>
        <source>One displacement jumps between two samples and stays there; no temperature moves. A gauge that was set to zero again and a probe that was touched look the same</source>
        <translation>某一位移在两次采样之间发生跳变并保持；没有温度随之变化。测头重新置零或被碰动，看起来也是如此</translation>
    </message>
    <message>
        <source>A surface starts fast and then goes on slowly, on the way up and on the way down</source>
        <translation>表面先快速变化，之后缓慢继续，升温和降温时都如此</translation>
    </message>
    <message>
        <source>Temperatures saw with a period of their own that no logged input has</source>
        <translation>温度以自身的周期呈锯齿状波动，任何已记录的输入都没有这一周期</translation>
    </message>
    <message>
        <source>The hot parts conduct otherwise than the cold ones; gradients do not grow in proportion to the heat</source>
        <translation>高温部位的导热与低温部位不同；温度梯度不与热量成正比增长</translation>
    </message>
    <message>
        <source>Opposite errors on the two sides of one place: the heated side too cold, the other too hot in the simulation</source>
        <translation>某处两侧的误差方向相反：仿真中受热一侧偏冷，另一侧偏热</translation>
    </message>
    <message>
        <source>All temperatures are simulated too hot, more so the longer it runs; the measured cool-down is faster</source>
        <translation>所有温度的仿真值都偏高，运行越久越明显；实测冷却更快</translation>
    </message>
    <message>
        <source>The simulation is too hot from the moment the coolant runs; the error steps with coolant_on</source>
        <translation>自冷却液开启起仿真温度偏高；误差随冷却液开关而跳变</translation>
    </message>
    <message>
        <source>The nose is simulated too cold while the machine cuts</source>
        <translation>切削时主轴端部的仿真温度偏低</translation>
    </message>
    <message>
        <source>All surfaces cool together during one stretch of time that no logged input explains. Coolant or compressed air that is not logged looks the same</source>
        <translation>所有表面在某一段时间内同时变冷，任何已记录的输入都无法解释。未记录的冷却液或压缩空气看起来也是如此</translation>
    </message>
    <message>
        <source>One place is simulated too cold; the error is largest there and spreads both ways</source>
        <translation>某一处的仿真温度偏低；误差在该处最大，并向两侧扩散</translation>
    </message>
    <message>
        <source>The heated end starts late and goes on warming after the heater is off</source>
        <translation>受热端升温滞后，热源关闭后仍继续升温</translation>
    </message>
    <message>
        <source>A part without a source of its own warms after its neighbour does</source>
        <translation>没有自身热源的部件在相邻部件之后升温</translation>
    </message>
    <message>
        <source>Like convection, but the hot part loses more than in proportion; below a rise of 20 K a tolerance of the film hides it</source>
        <translation>与对流类似，但高温部位的散热超过正比关系；温升低于 20 K 时会被膜系数的公差掩盖</translation>
    </message>
    <message>
        <source>All temperatures tend to another level than the logged room, also while the machine stands</source>
        <translation>所有温度都趋向与所记录室温不同的水平，机床静止时也如此</translation>
    </message>
    <message>
        <source>One channel is off in proportion to its rise, in step with it. A sensor that touches its part badly looks the same</source>
        <translation>某一通道的偏差与其温升成正比且同步。传感器与部件接触不良看起来也是如此</translation>
    </message>
    <message>
        <source>One channel is late in every transient and right when the temperature stands</source>
        <translation>某一通道在每次瞬态中滞后，温度稳定时正确</translation>
    </message>
    <message>
        <source>One channel differs by a constant from the first sample on</source>
        <translation>某一通道自第一次采样起相差一个常数</translation>
    </message>
    <message>
        <source>The simulation is too hot while the spindle turns and right while it stands</source>
        <translation>主轴旋转时仿真温度偏高，静止时正确</translation>
    </message>
    <message>
        <source>At one speed the part is warmer than the laws in n and n^2 can make it beside the other speeds</source>
        <translation>在某一转速下，该部件的温度高于 n 和 n² 规律在其他转速下给出的水平</translation>
    </message>
    <message>
        <source>The part is warmer than its surroundings even before the machine runs</source>
        <translation>机床运行之前，该部件的温度已高于周围环境</translation>
    </message>
    <message>
        <source>Only displacements are off; they follow the room with a delay</source>
        <translation>只有位移存在偏差；位移滞后地跟随室温</translation>
    </message>
    <message>
        <source>Only the displacement across the axis is off; it follows a heat source or a temperature difference with a delay</source>
        <translation>只有横向位移存在偏差；它滞后地跟随某一热源或温差</translation>
    </message>
    <message>
        <source>rise of %1</source>
        <translation>%1 的温升</translation>
    </message>
    <message>
        <source>A displacement follows another part&apos;s temperature, heating and cooling alike</source>
        <translation>某一位移跟随另一部件的温度，升温和降温时一致</translation>
    </message>
    <message>
        <source>A displacement is late against the temperature of its own component; heating and cooling disagree</source>
        <translation>某一位移滞后于其自身部件的温度；升温与降温曲线不重合</translation>
    </message>
    <message>
        <source>%1 samples</source>
        <translation>%1 个采样</translation>
    </message>
    <message>
        <source>at least one</source>
        <translation>至少一个</translation>
    </message>
    <message>
        <source>two thirds of full speed, 40 % of the time without coolant, 35 % with it, then stop and record the cooling</source>
        <translation>以最高转速的三分之二运行：40 % 的时间不开冷却液，35 % 的时间开冷却液，然后停机并记录冷却过程</translation>
    </message>
    <message>
        <source>full speed without coolant for half of the time, then stop and record the cooling</source>
        <translation>一半时间以最高转速运行，不开冷却液，然后停机并记录冷却过程</translation>
    </message>
    <message>
        <source>half speed without coolant</source>
        <translation>以最高转速的一半运行，不开冷却液</translation>
    </message>
    <message>
        <source>25, 50, 75 and 100 % of full speed, a quarter of the time each</source>
        <translation>以最高转速的 25、50、75 和 100 % 运行，各占四分之一时间</translation>
    </message>
    <message>
        <source>full speed and stop in turn, four equal parts</source>
        <translation>最高转速与停机交替，共四个等长阶段</translation>
    </message>
    <message>
        <source>full speed, coolant off and on in turn, four equal parts</source>
        <translation>以最高转速运行，冷却液关、开交替，共四个等长阶段</translation>
    </message>
    <message>
        <source>half speed cold, full speed for half of the time, half speed hot, then stop</source>
        <translation>冷态下以半速运行，一半时间全速运行，热态下再以半速运行，然后停机</translation>
    </message>
    <message>
        <source>half speed, no cutting and cutting in turn, four equal parts</source>
        <translation>以半速运行，不切削与切削交替，共四个等长阶段</translation>
    </message>
    <message>
        <source>µm per unit of its driver</source>
        <translation>µm / 驱动量单位</translation>
    </message>
    <message>
        <source>all the time</source>
        <translation>始终</translation>
    </message>
    <message>
        <source>in step with the spindle speed</source>
        <translation>与主轴转速同步</translation>
    </message>
    <message>
        <source>with the square of the spindle speed</source>
        <translation>随主轴转速的平方</translation>
    </message>
    <message>
        <source>while the spindle turns</source>
        <translation>主轴旋转期间</translation>
    </message>
    <message>
        <source>while the coolant runs</source>
        <translation>冷却液开启期间</translation>
    </message>
    <message>
        <source>while the machine cuts</source>
        <translation>切削期间</translation>
    </message>
    <message>
        <source>as the room changes</source>
        <translation>随室温变化</translation>
    </message>
    <message>
        <source>at irregular times</source>
        <translation>在不规则的时段</translation>
    </message>
    <message>
        <source>noise of %1 um</source>
        <translation>噪声 %1 um</translation>
    </message>
    <message>
        <source>%1, columns %2 and %3</source>
        <translation>%1，列 %2 和 %3</translation>
    </message>
    <message>
        <source>%1 warming as %2 should</source>
        <translation>%1 的升温如同 %2 应有的升温</translation>
    </message>
    <message>
        <source>the room in the room&apos;s column (are the two exchanged?)</source>
        <translation>室温列中应为室温（两列是否互换？）</translation>
    </message>
    <message>
        <source>less than 50 um: is it in nm?</source>
        <translation>小于 50 um：数据单位是否为 nm？</translation>
    </message>
    <message>
        <source>a movement of %1 %2</source>
        <translation>%1 %2 的移动</translation>
    </message>
    <message>
        <source>about %1 %2 for %3; check units, geometry and powers</source>
        <translation>%3 约为 %1 %2；请检查单位、几何尺寸和功率</translation>
    </message>
    <message>
        <source>%1; corrected by the run %2</source>
        <translation>%1；已按运行 %2 修正</translation>
    </message>
    <message>
        <source>always %1</source>
        <translation>始终为 %1</translation>
    </message>
    <message>
        <source>starts at %1</source>
        <translation>起始为 %1</translation>
    </message>
    <message>
        <source>no samples from %1 s</source>
        <translation>自 %1 s 起没有采样</translation>
    </message>
    <message>
        <source>frozen from %1 s</source>
        <translation>自 %1 s 起冻结</translation>
    </message>
    <message>
        <source>as asked for</source>
        <translation>按要求</translation>
    </message>
    <message>
        <source>the errors move in opposite directions: %1 of the best sensor&apos;s %2 would cancel</source>
        <translation>各误差变化方向相反：最佳传感器的 %2 中有 %1 会相互抵消</translation>
    </message>
    <message>
        <source>the errors move in one direction, so signs cannot cancel</source>
        <translation>各误差变化方向相同，符号不会相互抵消</translation>
    </message>
    <message>
        <source>the number of clusters</source>
        <translation>聚类数</translation>
    </message>
    <message>
        <source>1 to %1 (usable sensors), or auto</source>
        <translation>1 至 %1（可用传感器数），或 auto</translation>
    </message>
    <message>
        <source>the regression</source>
        <translation>回归</translation>
    </message>
    <message>
        <source>%1 measurements</source>
        <translation>%1 次测量</translation>
    </message>
    <message>
        <source>at least %1</source>
        <translation>至少 %1</translation>
    </message>
    <message>
        <source>gives no samples</source>
        <translation>没有采样值</translation>
    </message>
    <message>
        <source>stopped during the run</source>
        <translation>在运行中停止工作</translation>
    </message>
    <message>
        <source>never moves</source>
        <translation>始终不变</translation>
    </message>
    <message>
        <source>repeats another sensor</source>
        <translation>与另一传感器重复</translation>
    </message>
    <message>
        <source>dropped out for a while</source>
        <translation>曾短时失去读数</translation>
    </message>
    <message>
        <source>has isolated spikes</source>
        <translation>有孤立的尖峰</translation>
    </message>
    <message>
        <source>has gaps</source>
        <translation>有缺失</translation>
    </message>
    <message>
        <source>has values no machine tool reaches</source>
        <translation>含有机床不可能达到的值</translation>
    </message>
    <message>
        <source>holds no measurement</source>
        <translation>没有测量值</translation>
    </message>
    <message>
        <source>hardly warmed up in this run</source>
        <translation>在本次运行中几乎没有升温</translation>
    </message>
    <message>
        <source>is nearly a combination of the others</source>
        <translation>几乎是其他传感器的线性组合</translation>
    </message>
    <message>
        <source>has hardly more measurements than parameters</source>
        <translation>测量次数仅略多于参数个数</translation>
    </message>
    <message>
        <source>is outside what the training saw</source>
        <translation>超出训练数据的范围</translation>
    </message>
    <message>
        <source>cannot be guaranteed from this recording</source>
        <translation>无法由本次记录保证</translation>
    </message>
    <message>
        <source>%1; it is not used</source>
        <translation>%1；未予采用</translation>
    </message>
    <message>
        <source>%1 on %2 sensors%3</source>
        <translation>%1，%2 个传感器%3</translation>
    </message>
    <message>
        <source>%1 and the simulation</source>
        <translation>%1及仿真</translation>
    </message>
    <message>
        <source>%1 and the inputs</source>
        <translation>%1及输入量</translation>
    </message>
    <message>
        <source>leaves %1 um rms with %2 left out</source>
        <translation>留出%2时残余误差 rms 为 %1 µm</translation>
    </message>
    <message>
        <source>%1 as asked for; %2</source>
        <translation>按要求采用 %1；%2</translation>
    </message>
    <message>
        <source>The warmest sensor rose by only %1 K: run longer or faster.</source>
        <translation>最热的传感器仅升温 %1 K：请延长运行时间或提高转速。</translation>
    </message>
    <message>
        <source>One speed only: a second stretch at another speed would allow a guaranteed band.</source>
        <translation>只有一种转速：再增加一段其他转速的运行，即可给出有保证的预测带。</translation>
    </message>
    <message>
        <source>the machine</source>
        <translation>机床</translation>
    </message>
    <message>
        <source>largest rise %1 K</source>
        <translation>最大温升 %1 K</translation>
    </message>
    <message>
        <source>the set of sensors</source>
        <translation>传感器组</translation>
    </message>
    <message>
        <source>condition number %1</source>
        <translation>条件数 %1</translation>
    </message>
    <message>
        <source>the fit</source>
        <translation>拟合</translation>
    </message>
    <message>
        <source>%1 blocks for %2 sensors</source>
        <translation>%2 个传感器对应 %1 个数据块</translation>
    </message>
    <message>
        <source>the coverage of the band</source>
        <translation>预测带的覆盖率</translation>
    </message>
    <message>
        <source>one cycle only</source>
        <translation>仅一个循环</translation>
    </message>
    <message>
        <source>ridge on %1 sensors (%2)</source>
        <translation>%1 个传感器的岭回归（%2）</translation>
    </message>
    <message>
        <source>the method</source>
        <translation>方法</translation>
    </message>
    <message>
        <source>physics without a machine description</source>
        <translation>物理模型缺少机床描述</translation>
    </message>
    <message>
        <source>the run</source>
        <translation>该运行</translation>
    </message>
    <message>
        <source>%1 blocks of measurements</source>
        <translation>%1 个测量数据块</translation>
    </message>
    <message>
        <source>at least 12</source>
        <translation>至少 12</translation>
    </message>
    <message>
        <source>each of %1 cycles in turn</source>
        <translation>%1 个循环中的每一个</translation>
    </message>
    <message>
        <source>the last quarter of the run</source>
        <translation>运行的最后四分之一</translation>
    </message>
    <message>
        <source>numbers above 0</source>
        <translation>大于 0 的数值</translation>
    </message>
    <message>
        <source>%1 % of the time, up to %2 of the trained range</source>
        <translation>%1 % 的时间，最多达训练范围的 %2</translation>
    </message>
    <message>
        <source>sensors together</source>
        <translation>各传感器的组合</translation>
    </message>
    <message>
        <source>longest %1 s</source>
        <translation>最长 %1 s</translation>
    </message>
    <message>
        <source>of %1</source>
        <translation>共 %1</translation>
    </message>
    <message>
        <source>%1 measurements left out</source>
        <translation>已略去 %1 次测量</translation>
    </message>
    <message>
        <source>at least 4</source>
        <translation>至少 4</translation>
    </message>
    <message>
        <source>%1 to %2 um</source>
        <translation>%1 至 %2 µm</translation>
    </message>
    <message>
        <source>errors of a machine, below a metre</source>
        <translation>机床的误差，小于一米</translation>
    </message>
    <message>
        <source>the recording %1</source>
        <translation>记录 %1</translation>
    </message>
    <message>
        <source>no temperature column</source>
        <translation>没有温度列</translation>
    </message>
    <message>
        <source>columns named like T1_C</source>
        <translation>名称形如 T1_C 的列</translation>
    </message>
    <message>
        <source>no error column</source>
        <translation>没有误差列</translation>
    </message>
    <message>
        <source>columns named like dZ_um</source>
        <translation>名称形如 dZ_um 的列</translation>
    </message>
    <message>
        <source>%1 rows</source>
        <translation>%1 行</translation>
    </message>
    <message>
        <source>every temperature of the recording %1</source>
        <translation>记录 %1 的所有温度</translation>
    </message>
    <message>
        <source>every error of the recording %1</source>
        <translation>记录 %1 的所有误差</translation>
    </message>
    <message>
        <source>%1 %2 (%3) leave %4 um rms with %5 left out, %6 um with the noise of single readings</source>
        <translation>%2 个%1（%3）：留出%5时残余误差 rms 为 %4 µm，计入单次读数噪声为 %6 µm</translation>
    </message>
    <message>
        <source>%1; %2 %3: %4 um</source>
        <translation>%1；%2 个%3：%4 µm</translation>
    </message>
    <message>
        <source>%1; what was left out does not tell them apart, and the mean of more sensors is quieter</source>
        <translation>%1；留出的数据无法区分它们，而更多传感器的平均噪声更小</translation>
    </message>
    <message>
        <source>sensitive points of the clusters</source>
        <translation>各聚类的热敏感点</translation>
    </message>
    <message>
        <source>that differ most</source>
        <translation>差异最大的传感器</translation>
    </message>
    <message>
        <source>nearest to the model on all</source>
        <translation>最接近全传感器模型的传感器</translation>
    </message>
    <message>
        <source>sensitive points and those that differ most from them</source>
        <translation>热敏感点及与其差异最大的传感器</translation>
    </message>
    <message>
        <source>all that are usable</source>
        <translation>全部可用传感器</translation>
    </message>
    <message>
        <source>no recording</source>
        <translation>没有记录</translation>
    </message>
    <message>
        <source>the recordings</source>
        <translation>各记录</translation>
    </message>
    <message>
        <source>no common sensor</source>
        <translation>没有共有的传感器</translation>
    </message>
    <message>
        <source>no common error</source>
        <translation>没有共有的误差</translation>
    </message>
    <message>
        <source>runs of the same machine</source>
        <translation>同一机床的运行</translation>
    </message>
    <message>
        <source>errors at %1 times</source>
        <translation>%1 个时刻的误差</translation>
    </message>
    <message>
        <source>at least 8, spread over the run</source>
        <translation>至少 8 个，分布于整个运行</translation>
    </message>
    <message>
        <source>%1 (%2); it is not used</source>
        <translation>%1（%2）；未予采用</translation>
    </message>
    <message>
        <source>it is not used</source>
        <translation>未予采用</translation>
    </message>
    <message>
        <source>%1 gives no samples</source>
        <translation>%1 没有采样值</translation>
    </message>
    <message>
        <source>%1 gives no samples (%2)</source>
        <translation>%1 没有采样值（%2）</translation>
    </message>
    <message>
        <source>%1 stopped during the run</source>
        <translation>%1 在运行中停止工作</translation>
    </message>
    <message>
        <source>%1 stopped during the run (%2)</source>
        <translation>%1 在运行中停止工作（%2）</translation>
    </message>
    <message>
        <source>%1 never moves</source>
        <translation>%1 始终不变</translation>
    </message>
    <message>
        <source>%1 never moves (%2)</source>
        <translation>%1 始终不变（%2）</translation>
    </message>
    <message>
        <source>%1 repeats another sensor</source>
        <translation>%1 与另一传感器重复</translation>
    </message>
    <message>
        <source>%1 repeats another sensor (%2)</source>
        <translation>%1 与另一传感器重复（%2）</translation>
    </message>
    <message>
        <source>%1 dropped out for a while (%2)</source>
        <translation>%1 曾短时失去读数（%2）</translation>
    </message>
    <message>
        <source>reads %1 from %2 to %3 s</source>
        <translation>自 %2 至 %3 s 读数为 %1</translation>
    </message>
    <message>
        <source>%1 has isolated spikes</source>
        <translation>%1 有孤立的尖峰</translation>
    </message>
    <message>
        <source>%1 has isolated spikes (%2)</source>
        <translation>%1 有孤立的尖峰（%2）</translation>
    </message>
    <message>
        <source>%1 has gaps</source>
        <translation>%1 有缺失</translation>
    </message>
    <message>
        <source>%1 has gaps (%2)</source>
        <translation>%1 有缺失（%2）</translation>
    </message>
    <message>
        <source>%1 has values no machine tool reaches</source>
        <translation>%1 含有机床不可能达到的值</translation>
    </message>
    <message>
        <source>%1 has values no machine tool reaches (%2)</source>
        <translation>%1 含有机床不可能达到的值（%2）</translation>
    </message>
    <message>
        <source>%1 holds no measurement</source>
        <translation>%1 没有测量值</translation>
    </message>
    <message>
        <source>%1 holds no measurement (%2)</source>
        <translation>%1 没有测量值（%2）</translation>
    </message>
    <message>
        <source>%1 hardly warmed up in this run</source>
        <translation>%1 在本次运行中几乎没有升温</translation>
    </message>
    <message>
        <source>%1 hardly warmed up in this run (%2)</source>
        <translation>%1 在本次运行中几乎没有升温（%2）</translation>
    </message>
    <message>
        <source>%1 is nearly a combination of the others</source>
        <translation>%1 几乎是其他传感器的线性组合</translation>
    </message>
    <message>
        <source>%1 is nearly a combination of the others (%2)</source>
        <translation>%1 几乎是其他传感器的线性组合（%2）</translation>
    </message>
    <message>
        <source>%1 has hardly more measurements than parameters</source>
        <translation>%1 的测量次数仅略多于参数个数</translation>
    </message>
    <message>
        <source>%1 has hardly more measurements than parameters (%2)</source>
        <translation>%1 的测量次数仅略多于参数个数（%2）</translation>
    </message>
    <message>
        <source>%1 is outside what the training saw</source>
        <translation>%1 超出训练数据的范围</translation>
    </message>
    <message>
        <source>%1 is outside what the training saw (%2)</source>
        <translation>%1 超出训练数据的范围（%2）</translation>
    </message>
    <message>
        <source>%1 cannot be guaranteed from this recording</source>
        <translation>%1 无法由本次记录保证</translation>
    </message>
    <message>
        <source>%1 cannot be guaranteed from this recording (%2)</source>
        <translation>%1 无法由本次记录保证（%2）</translation>
    </message>
    <message>
        <source>%1 and the simulation and the inputs</source>
        <translation>%1及仿真和输入量</translation>
    </message>
    <message>
        <source>all</source>
        <translation>全部</translation>
    </message>
    <message>
        <source>mlr</source>
        <translation>多元线性回归</translation>
    </message>
    <message>
        <source>ridge</source>
        <translation>岭回归</translation>
    </message>
    <message>
        <source>pcr</source>
        <translation>主成分回归</translation>
    </message>
    <message>
        <source>lasso</source>
        <translation>LASSO 回归</translation>
    </message>
    <message>
        <source>robust</source>
        <translation>稳健回归</translation>
    </message>
    <message>
        <source>dynamic</source>
        <translation>动态模型</translation>
    </message>
    <message>
        <source>arx</source>
        <translation>ARX 模型</translation>
    </message>
    <message>
        <source>greybox</source>
        <translation>灰箱模型</translation>
    </message>
    <message>
        <source>physics</source>
        <translation>物理模型</translation>
    </message>
    <message>
        <source>drift = %1</source>
        <translation>漂移 = %1</translation>
    </message>
    <message>
        <source>gain = %1</source>
        <translation>增益误差 = %1</translation>
    </message>
    <message>
        <source>excess = %1</source>
        <translation>超出 = %1</translation>
    </message>
    <message>
        <source>step = %1</source>
        <translation>跳变 = %1</translation>
    </message>
    <message>
        <source>from = %1</source>
        <translation>自 = %1</translation>
    </message>
    <message>
        <source>to = %1</source>
        <translation>至 = %1</translation>
    </message>
    <message>
        <source>period = %1</source>
        <translation>周期 = %1</translation>
    </message>
    <message>
        <source>slope = %1</source>
        <translation>斜率 = %1</translation>
    </message>
    <message>
        <source>%1 µm per unit of its driver</source>
        <translation>%1 µm / 驱动量单位</translation>
    </message>
    <message>
        <source>spindle</source>
        <translation>主轴</translation>
    </message>
    <message>
        <source>motor</source>
        <translation>电机</translation>
    </message>
    <message>
        <source>rear bearing</source>
        <translation>后轴承</translation>
    </message>
    <message>
        <source>front bearing</source>
        <translation>前轴承</translation>
    </message>
    <message>
        <source>column</source>
        <translation>立柱</translation>
    </message>
    <message>
        <source>headstock</source>
        <translation>主轴箱</translation>
    </message>
    <message>
        <source>bed</source>
        <translation>床身</translation>
    </message>
    <message>
        <source>screw</source>
        <translation>丝杠</translation>
    </message>
    <message>
        <source>component</source>
        <translation>部件</translation>
    </message>
    <message>
        <source>Nothing is missing: the simulation agrees with the recording within its tolerances and the sensors&apos; noise.</source>
        <translation>没有缺失：仿真与记录在公差和传感器噪声范围内一致。</translation>
    </message>
    <message>
        <source>The description holds {@name}, which the recording does not show; without it nothing is missing. Take it out of the description, or check its numbers.</source>
        <translation>描述中含有{@name}，而记录并未显示；去掉它便没有缺失。请将其从描述中删除，或核对其数值。</translation>
    </message>
    <message>
        <source>The description holds {@name}, which the recording does not show: what is named is beside the description without it. Take it out, or check its numbers.</source>
        <translation>描述中含有{@name}，而记录并未显示：所命名的效应是针对去掉它之后的描述而言。请将其删除，或核对其数值。</translation>
    </message>
    <message>
        <source>Nothing is missing of what this recording can show: the simulation agrees with it within its tolerances and the sensors&apos; noise.</source>
        <translation>在本记录所能显示的范围内没有缺失：仿真与记录在公差和传感器噪声范围内一致。</translation>
    </message>
    <message>
        <source>Something is missing that the library does not explain: worst at {channel}, {@regime}, about {watts} W.</source>
        <translation>存在效应库无法解释的缺失：{channel} 处最严重，{@regime}，约 {watts} W。</translation>
    </message>
    <message>
        <source>The simulation left out {+effects}.</source>
        <translation>仿真遗漏了{+effects}。</translation>
    </message>
    <message>
        <source>{@regime}, {channel} is {before} {unit} (rms) off the best simulation without it. Adding {@name}{@where} ({parameters}) removes {removed_percent} % of that{@heat}. Typical of it: {@fingerprint}.</source>
        <translation>{@regime}，不计入该效应时 {channel} 与最佳仿真相差 {before} {unit}（rms）。计入{@where}{@name}（{parameters}）可消除其中的 {removed_percent} %{@heat}。典型特征：{@fingerprint}。</translation>
    </message>
    <message>
        <source>{@regime}, adding {@name}{@where} ({parameters}) brings {channel} from {before} to {after} {unit} (rms), of which {noise} {unit} is its noise{@heat}. Typical of it: {@fingerprint}.</source>
        <translation>{@regime}，计入{@where}{@name}（{parameters}）可使 {channel} 的偏差由 {before} 降至 {after} {unit}（rms），其中 {noise} {unit} 为其噪声{@heat}。典型特征：{@fingerprint}。</translation>
    </message>
    <message>
        <source>{@regime}, adding {@name}{@where} ({parameters}) explains how {channel} goes (log evidence {evidence}), but leaves it {before} {unit} (rms) off{@heat}. Typical of it: {@fingerprint}.</source>
        <translation>{@regime}，计入{@where}{@name}（{parameters}）可解释 {channel} 的变化过程（对数证据 {evidence}），但仍相差 {before} {unit}（rms）{@heat}。典型特征：{@fingerprint}。</translation>
    </message>
    <message>
        <source>full power for half of the time, then off, and record the cooling</source>
        <translation>一半时间全功率，然后关闭并记录冷却过程</translation>
    </message>
    <message>
        <source>full power and off in turn, four equal parts</source>
        <translation>全功率与关闭交替，共四个等长阶段</translation>
    </message>
    <message>
        <source>25, 50, 75 and 100 % of full power, a quarter of the time each</source>
        <translation>满功率的 25、50、75 和 100 %，各占四分之一时间</translation>
    </message>
    <message>
        <source>Beside what is named, {channels} show more that the library does not explain.</source>
        <translation>除已命名的效应外，{channels} 还有效应库无法解释的偏差。</translation>
    </message>
    <message>
        <source>The heat capacity of {parts} is not described and was assumed: watts, W/K and J/K are in proportion to it, the times are not.</source>
        <translation>{parts} 的热容未给出，采用了假定值：W、W/K 和 J/K 与其成正比，时间常数则不受影响。</translation>
    </message>
    <message>
        <source>; it brings {watts} on average while it acts</source>
        <translation>；起作用期间平均带入 {watts}</translation>
    </message>
    <message>
        <source>; it takes away {watts} on average while it acts</source>
        <translation>；起作用期间平均带走 {watts}</translation>
    </message>
    <message>
        <source>This recording is explained almost as well by {@name}{@where} (log evidence {behind} behind): it cannot be excluded.</source>
        <translation>{@where}{@name}对本记录的解释几乎同样好（对数证据仅低 {behind}），不能排除。</translation>
    </message>
    <message>
        <source>To tell {@best} from {@rival}, {minutes} min in all: {@run}.</source>
        <translation>为区分{@best}与{@rival}（共 {minutes} min）：{@run}。</translation>
    </message>
    <message>
        <source>The profile holds no machine description, so there is nothing to simulate.</source>
        <translation>配置文件不含机床描述，无法仿真。</translation>
    </message>
    <message>
        <source>The simulation differs most from the recording at {channel}: {rms} {unit} rms, {largest} {unit} at the most after {minutes} min.</source>
        <translation>仿真与记录在 {channel} 处差异最大：rms {rms} {unit}，最大 {largest} {unit}，出现在 {minutes} min。</translation>
    </message>
    <message>
        <source>The temperature of {component} between {from} and {to} mm from its fixed end follows the elongation best: a sensor belongs there.</source>
        <translation>{component}距固定端 {from} 至 {to} mm 处的温度与热伸长的相关性最好：传感器应布置在该处。</translation>
    </message>
    <message>
        <source> on {place_channel}</source>
        <translation>{place_channel}的</translation>
    </message>
    <message>
        <source> at {position} mm of {component}</source>
        <translation>{component} {position} mm 处的</translation>
    </message>
    <message>
        <source> between {from} and {to} mm</source>
        <translation>位于 {from} 至 {to} mm 之间的</translation>
    </message>
    <message>
        <source> of {component}</source>
        <translation>{component}的</translation>
    </message>
    <message>
        <source> and </source>
        <translation>和</translation>
    </message>
    <message>
        <source> or </source>
        <translation>或</translation>
    </message>
    <message>
        <source>convection to the room</source>
        <translation>向环境的对流散热</translation>
    </message>
    <message>
        <source>convection that grows with speed</source>
        <translation>随转速增强的对流散热</translation>
    </message>
    <message>
        <source>radiation to the room</source>
        <translation>向环境的辐射散热</translation>
    </message>
    <message>
        <source>cooling by the coolant</source>
        <translation>冷却液的冷却</translation>
    </message>
    <message>
        <source>bearing oil that thins as it warms</source>
        <translation>轴承润滑油受热变稀</translation>
    </message>
    <message>
        <source>a different bearing preload</source>
        <translation>与描述不同的轴承预紧力</translation>
    </message>
    <message>
        <source>bearing preload that grows with speed</source>
        <translation>随转速增大的轴承预紧力</translation>
    </message>
    <message>
        <source>bearing preload that grows with the heat</source>
        <translation>随温升增大的轴承预紧力</translation>
    </message>
    <message>
        <source>an extra heat source</source>
        <translation>额外热源</translation>
    </message>
    <message>
        <source>a joint that conducts badly</source>
        <translation>接触热阻过大的结合面</translation>
    </message>
    <message>
        <source>the structure following the room</source>
        <translation>结构件随室温变化</translation>
    </message>
    <message>
        <source>bending of the structure</source>
        <translation>结构件弯曲</translation>
    </message>
    <message>
        <source>a sensor that answers late</source>
        <translation>传感器响应滞后</translation>
    </message>
    <message>
        <source>a sensor that reads wrong by a constant</source>
        <translation>传感器恒定偏差</translation>
    </message>
    <message>
        <source>a sensor that reads its rise wrong</source>
        <translation>传感器温升示值误差</translation>
    </message>
    <message>
        <source>heat of cutting at the nose</source>
        <translation>主轴端部的切削热</translation>
    </message>
    <message>
        <source>a draught or an open door</source>
        <translation>气流扰动或门未关</translation>
    </message>
    <message>
        <source>a chiller that switches on its own</source>
        <translation>自行启停的冷却机</translation>
    </message>
    <message>
        <source>bearings that run in</source>
        <translation>轴承磨合</translation>
    </message>
    <message>
        <source>conductivity that changes with temperature</source>
        <translation>随温度变化的导热系数</translation>
    </message>
    <message>
        <source>a wrong room sensor</source>
        <translation>室温传感器示值错误</translation>
    </message>
    <message>
        <source>a bracket that slipped</source>
        <translation>支架滑移</translation>
    </message>
    <message>
        <source>heat from a neighbouring part</source>
        <translation>相邻部件传来的热量</translation>
    </message>
    <message>
        <source>the heat source&apos;s own body</source>
        <translation>热源自身的热容</translation>
    </message>
    <message>
        <source>a slow core behind the surface</source>
        <translation>表层之后响应缓慢的内芯</translation>
    </message>
    <message>
        <source>a heat that is there at rest as well</source>
        <translation>静止时也存在的热量</translation>
    </message>
    <message>
        <source>heat as a curve over speed</source>
        <translation>随转速按曲线变化的热量</translation>
    </message>
    <message>
        <source>a displacement that follows another part</source>
        <translation>跟随另一部件的位移</translation>
    </message>
    <message>
        <source>heat that something unlogged switches</source>
        <translation>由未记录的开关控制的热量</translation>
    </message>
    <message>
        <source>a film that a logged input drives</source>
        <translation>由已记录输入驱动的换热</translation>
    </message>
    <message>
        <source>a structure that follows late</source>
        <translation>响应滞后的结构件</translation>
    </message>
    <message>
        <source>%1: unknown key &quot;%2&quot; is kept and ignored</source>
        <translation>%1：未知的键“%2”已保留但忽略</translation>
    </message>
    <message>
        <source>the channels that %1 and %2 share</source>
        <translation>%1与%2共有的通道</translation>
    </message>
    <message>
        <source>the recording and the description</source>
        <translation>记录与描述</translation>
    </message>
    <message>
        <source>the machine is not at the measuring position</source>
        <translation>机床不在测量位置</translation>
    </message>
    <message>
        <source>the zero of the warm-up run cannot be restored</source>
        <translation>无法恢复暖机运行的零点</translation>
    </message>
    <message>
        <source>the machine of this job</source>
        <translation>本作业的机床</translation>
    </message>
    <message>
        <source>serial %1 connected</source>
        <translation>已连接序列号 %1</translation>
    </message>
    <message>
        <source>a physics model, which predicts recordings</source>
        <translation>用于预测记录的物理模型</translation>
    </message>
    <message>
        <source>one that runs sample by sample</source>
        <translation>可逐个采样运行的模型</translation>
    </message>
    <message>
        <source>compensate from this computer</source>
        <translation>由本计算机补偿</translation>
    </message>
    <message>
        <source>0 um, switch on</source>
        <translation>0 µm，开关接通</translation>
    </message>
    <message>
        <source>0 um, switch off</source>
        <translation>0 µm，开关断开</translation>
    </message>
    <message>
        <source>what the model says, at most %1 um, every %2 s</source>
        <translation>按模型，最大 %1 µm，每 %2 s</translation>
    </message>
    <message>
        <source>Error in %1</source>
        <translation>%1 方向误差</translation>
    </message>
    <message>
        <source>Tilt %1</source>
        <translation>%1 倾角</translation>
    </message>
    <message>
        <source>the region</source>
        <translation>区域</translation>
    </message>
    <message>
        <source>%1 temperatures and %2 errors, %3 values each</source>
        <translation>%1 个温度和 %2 个误差，各 %3 个值</translation>
    </message>
    <message>
        <source>%1 values each</source>
        <translation>各 %1 个值</translation>
    </message>
    <message>
        <source>%1 temperatures and %2</source>
        <translation>%1 个温度和 %2</translation>
    </message>
    <message>
        <source>imported from %1: that the compensation was off is not recorded</source>
        <translation>由 %1 导入：未记录补偿是否断开</translation>
    </message>
    <message>
        <source>imported from %1</source>
        <translation>由 %1 导入</translation>
    </message>
    <message>
        <source>%1: that the compensation was off is not recorded</source>
        <translation>%1：未记录补偿是否断开</translation>
    </message>
    <message>
        <source>Something is missing that the library does not explain: {channel} is off the best simulation by {rms} {unit} (rms), {@regime}.</source>
        <translation>存在效应库无法解释的缺失：{channel} 与最佳仿真相差 {rms} {unit}（rms），{@regime}。</translation>
    </message>
    <message>
        <source>This recording cannot tell whether there is {|effects}: even as strong as it can be at all, it would not have shown here.</source>
        <translation>本次记录无法判断是否存在{|effects}：即使它达到可能的最大强度，在本次记录中也不会显现。</translation>
    </message>
    <message>
        <source>No effect of the library is missing, but the simulation agrees with the recording only with numbers far from those described.</source>
        <translation>没有缺少效应库中的效应，但只有在参数与描述相差很大时，仿真才与记录一致。</translation>
    </message>
    <message>
        <source>To fit, {@quantity} of {part} had to become {factor} times what is described, {widths} times its tolerance: check units, sizes and powers.</source>
        <translation>为了拟合，{part}的{@quantity}须为所述值的 {factor} 倍，偏差为其容差的 {widths} 倍：请检查单位、尺寸和功率。</translation>
    </message>
    <message>
        <source>the heat</source>
        <translation>发热量</translation>
    </message>
    <message>
        <source>the conductivity</source>
        <translation>导热系数</translation>
    </message>
    <message>
        <source>the heat capacity</source>
        <translation>热容</translation>
    </message>
    <message>
        <source>the expansion</source>
        <translation>热膨胀</translation>
    </message>
    <message>
        <source>the film to the room</source>
        <translation>对室内空气的换热</translation>
    </message>
    <message>
        <source>This recording cannot tell whether anything is missing: the simulation agrees with it, but most effects of usual size would not have shown. Record for longer, until the temperatures settle, with several speeds and stops.</source>
        <translation>本次记录无法判断是否遗漏了什么：仿真与其一致，但大多数通常大小的效应在其中不会显现。请记录更长时间直至温度稳定，并包含多个转速和停机。</translation>
    </message>
    <message>
        <source>Nothing can be named: the sensors are not where the description has them. Correct that first.</source>
        <translation>无法指明任何效应：传感器的位置与描述不符。请先更正。</translation>
    </message>
    <message>
        <source>{component} is described {described} mm thick: about {fits} mm explains the recording far better. Measure its outer diameter.</source>
        <translation>{component} 描述为直径 {described} mm：若约为 {fits} mm，则能好得多地解释本次记录。请实测其外径。</translation>
    </message>
    <message>
        <source>The sensors of {component} read as if all of them sat about {fits} mm nearer to the fixed end than described: check from where their places are told.</source>
        <translation>{component} 的各传感器读数表明它们全都比描述中离固定端近约 {fits} mm：请检查其位置从何处量起。</translation>
    </message>
    <message>
        <source>The sensors of {component} read as if all of them sat about {fits} mm farther from the fixed end than described: check from where their places are told.</source>
        <translation>{component} 的各传感器读数表明它们全都比描述中离固定端远约 {fits} mm：请检查其位置从何处量起。</translation>
    </message>
    <message>
        <source>The sensors of {component} read as if their places were told from the other end than those of its heat sources: count both from the fixed end.</source>
        <translation>{component} 的传感器读数表明其位置与热源位置是从相反的两端量起的：两者都应从固定端量起。</translation>
    </message>
    <message>
        <source>As heat it would come in between {from} and {to} mm of {component}.</source>
        <translation>若视为热量，则由 {component} 的 {from} 至 {to} mm 处进入。</translation>
    </message>
    <message>
        <source>It shows most at {+spans} min.</source>
        <translation>在第 {+spans} 分钟最为明显。</translation>
    </message>
    <message>
        <source>{component} is described {described} mm long, with nothing on its last {bare} mm: a length of about {fits} mm explains the recording far better. Measure it.</source>
        <translation>{component} 描述为长 {described} mm，其末端 {bare} mm 上没有任何东西：若长约 {fits} mm，则能好得多地解释本次记录。请实测其长度。</translation>
    </message>
    <message>
        <source>Nothing can be named: the machine does not have the sizes described. Correct that first.</source>
        <translation>无法指明任何效应：机床的尺寸与描述不符。请先更正。</translation>
    </message>
    <message>
        <source>{channel} reads as a sensor about {at} mm from the fixed end would, not one at {described} mm as described: check its place, and that it is in millimetres.</source>
        <translation>{channel} 的读数像是距固定端约 {at} mm 处的传感器，而非描述中 {described} mm 处的：请检查其位置以及单位是否为毫米。</translation>
    </message>
    <message>
        <source>In {recording} the clock jumps ahead by {by} min at {at} min: the machine went on as if no time had passed, and the times were taken so.</source>
        <translation>记录 {recording} 的时钟在第 {at} 分钟向前跳了 {by} 分钟：机床的变化表明其间没有时间流逝，时间已据此更正。</translation>
    </message>
    <message>
        <source>The sensors read as if their places were described in {unit}, not in mm: correct the description.</source>
        <translation>各传感器的读数表明其位置是以 {unit} 而非 mm 描述的：请更正描述。</translation>
    </message>
    <message>
        <source>{channel} and {other} read as if they had changed places: check their cables and the order of the columns.</source>
        <translation>{channel} 与 {other} 的读数像是互换了位置：请检查接线和列的顺序。</translation>
    </message>
    <message>
        <source>The recording has no column {column}: how the room went had to be guessed from the machine&apos;s own temperatures, and what follows the room can hardly be told from it.</source>
        <translation>记录中没有列 {column}：室温的变化只能由机床自身的温度推测，跟随室温的效应难以与之区分。</translation>
    </message>
    <message>
        <source>The recording has no column {columns}: what acts with it cannot be found. If the machine has it, log it and record again.</source>
        <translation>记录中没有列 {columns}：随之作用的效应无法查明。若机床有此项，请接入记录后重新测量。</translation>
    </message>
    <message>
        <source>The recording has no column {columns}: what shows in it alone cannot be found.</source>
        <translation>记录中没有列 {columns}：只在该列中显现的效应无法查明。</translation>
    </message>
    <message>
        <source>What drives the machine was recorded about {seconds} s after it acted, and was taken as that much earlier: give all columns one clock.</source>
        <translation>驱动机床各量的记录比其实际作用晚约 {seconds} s，已据此提前处理：请让各列使用同一时钟。</translation>
    </message>
    <message>
        <source>What drives the machine was recorded about {seconds} s before it acted, and was taken as that much later: give all columns one clock.</source>
        <translation>驱动机床各量的记录比其实际作用早约 {seconds} s，已据此推后处理：请让各列使用同一时钟。</translation>
    </message>
    <message>
        <source>In {recording} the column {column} has no value in {percent} % of the rows: what it was there had to be assumed.</source>
        <translation>{recording} 的列 {column} 有 {percent} % 的行没有数值：其间的值只能假定。</translation>
    </message>
    <message>
        <source>The recording starts with {part} {above} K above its room: what ran before is not recorded and had to be fitted as well. Start after a rest of some hours to be surer.</source>
        <translation>记录开始时 {part} 比室温高 {above} K：此前的运行没有记录，只能一并拟合。静置数小时后再开始，结论会更可靠。</translation>
    </message>
    <message>
        <source>The recording starts with {part} {above} K below its room: what ran before is not recorded and had to be fitted as well. Start after a rest of some hours to be surer.</source>
        <translation>记录开始时 {part} 比室温低 {above} K：此前的运行没有记录，只能一并拟合。静置数小时后再开始，结论会更可靠。</translation>
    </message>
    <message>
        <source>Recording {recording}: the machine description does not name {columns}, which was not used.</source>
        <translation>记录 {recording}：机床描述中没有 {columns}，未予使用。</translation>
    </message>
    <message>
        <source>This recording cannot tell whether there is {|effects}: what drives that never acted in it.</source>
        <translation>本次记录无法判断是否存在{|effects}：驱动它的输入从未动作。</translation>
    </message>
    <message>
        <source>The rows are {seconds} s apart, and when speed or coolant switched in between is known no better: record a row every 60 s or more often to be surer.</source>
        <translation>各行相隔 {seconds} s，其间转速或冷却切换的时刻无法知道得更准：要更可靠，请至少每 60 s 记录一行。</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
    <message>
        <source>up to {:.4g} rpm</source>
        <translation>高达 {:.4g} rpm</translation>
    </message>
    <message>
        <source>the speed in rpm (by {} it is in {})</source>
        <translation>以 rpm 为单位的转速（按 {}，其单位为 {}）</translation>
    </message>
    <message>
        <source>speeds of a motor rated at {:g} rpm</source>
        <translation>额定 {:g} rpm 电机的转速</translation>
    </message>
    <message>
        <source>at most {:.3g} rpm</source>
        <translation>最高 {:.3g} rpm</translation>
    </message>
    <message>
        <source>In {recording} the spindle&apos;s load is at most {most} W, next to nothing for this motor: is spindle_load_W in {unit}?</source>
        <translation>{recording} 中主轴负载最大仅 {most} W，对该电机几乎为零：spindle_load_W 的单位是否为 {unit}？</translation>
    </message>
    <message>
        <source>speeds of a motor rated at {:g} rpm (are they in 1000 rpm?)</source>
        <translation>额定转速 {:g} rpm 的电机应有的转速（单位是否为 1000 rpm？）</translation>
    </message>
    <message>
        <source>speeds of a motor rated at {:g} rpm (are they in % of that?)</source>
        <translation>额定转速 {:g} rpm 电机的转速（单位是否为其百分比？）</translation>
    </message>
    <message>
        <source>0 rpm all the time beside a load of up to {:.4g} W</source>
        <translation>转速始终为 0 rpm，而负载最高达 {:.4g} W</translation>
    </message>
    <message>
        <source>the spindle&apos;s speed (was it logged?)</source>
        <translation>主轴转速（是否已记录？）</translation>
    </message>
    <message>
        <source>about {:.3g} um for {} (is it in mm?)</source>
        <translation>{1} 约 {0:.3g} um（单位是否为 mm？）</translation>
    </message>
    <message>
        <source>{} of its rows number for number in {}</source>
        <translation>其中 {0} 行与 {1} 中的数值完全相同</translation>
    </message>
    <message>
        <source>Nothing drives the machine in this recording: little can be learned from it.</source>
        <translation>本次记录中没有任何输入驱动机床：从中能得到的信息很少。</translation>
    </message>
    <message>
        <source>With its sign turned, {channel} is as described: check which way it counts as positive.</source>
        <translation>将符号反转后，{channel} 与描述一致：请检查哪个方向记为正。</translation>
    </message>
    <message>
        <source>To see whether there is {@rival}, {minutes} min in all: {@run}.</source>
        <translation>为判断是否存在{@rival}（共 {minutes} min）：{@run}。</translation>
    </message>
    <message>
        <source>Something is missing that the library does not explain: worst at {channel}, {@regime}, where about {watts} W too much heat is simulated.</source>
        <translation>存在效应库无法解释的缺失：{channel} 处最严重，{@regime}，仿真的热量约多出 {watts} W。</translation>
    </message>
    <message>
        <source>Temperature sensors on {part} that were used: {count}. Where along it something happens can hardly be told from so few; three or more, spread over its length, show places.</source>
        <translation>{part} 上所用的温度传感器数量：{count}。数量太少，难以判断现象发生在其何处；沿其长度布置三个或更多传感器才能显示位置。</translation>
    </message>
    <message>
        <source>The description states a smaller tolerance for {+quantities} than anybody can know such a number to: {values} was taken instead.</source>
        <translation>描述中{+quantities}的容差小于任何人所能确知的程度：已改用 {values}。</translation>
    </message>
    <message>
        <source>To fit, the joint {part} had to conduct {factor} times what is described, {widths} times its tolerance: look at its seat, its bolts and what fills its gap, and then at its figure.</source>
        <translation>为了吻合，接合处 {part} 的热导必须变为所述值的 {factor} 倍，是其容差的 {widths} 倍：请先检查其配合面、螺栓和间隙中的填充物，再检查其数值。</translation>
    </message>
    <message>
        <source>the conductance of joints</source>
        <translation>接合处的热导</translation>
    </message>
    <message>
        <source>Recording {recording}: {channel} never changes (it is always {value}) although {um} µm are simulated: is the gauge connected? It was not used.</source>
        <translation>记录 {recording}：{channel} 始终不变（始终为 {value}），而仿真值变化了 {um} µm：测头是否已连接？未予使用。</translation>
    </message>
    <message>
        <source>%1 of %2 samples left out</source>
        <translation>%2 个采样中已剔除 %1 个</translation>
    </message>
    <message>
        <source>the offset is moved by %1 um; the run does not show that the temperature terms are wrong, so they stay</source>
        <translation>偏置移动 %1 µm；该运行未表明温度项有误，因此保持不变</translation>
    </message>
    <message>
        <source>%1; one cycle cannot rank them (a second speed would), so fits on the first few of them are averaged, and what the run leaves open is filled by how machines are built</source>
        <translation>%1；仅一个循环无法排序（需要第二种转速），因此对其中前几个的拟合取平均，运行未能确定的部分按机床的一般构造补充</translation>
    </message>
    <message>
        <source>the controller does not answer</source>
        <translation>控制器没有应答</translation>
    </message>
    <message>
        <source>the controller applies %1 um in %2 where %3 um was written: something else compensates</source>
        <translation>控制器在 %2 方向施加了 %1 um，而写入的是 %3 um：另有补偿在起作用</translation>
    </message>
    <message>
        <source>the PIN could not be hashed</source>
        <translation>PIN 无法加密保存</translation>
    </message>
    <message>
        <source>%1 hexadecimal digits</source>
        <translation>%1 位十六进制数字</translation>
    </message>
    <message>
        <source>no random numbers</source>
        <translation>无法取得随机数</translation>
    </message>
    <message>
        <source>a power of two</source>
        <translation>2 的幂</translation>
    </message>
    <message>
        <source>the idle time</source>
        <translation>空闲时间</translation>
    </message>
    <message>
        <source>brackets within brackets, more than %1</source>
        <translation>括号嵌套超过 %1 层</translation>
    </message>
    <message>
        <source>&quot;%1&quot; in it was not made by this program</source>
        <translation>其中的“%1”不是由本程序创建的</translation>
    </message>
    <message>
        <source>version %1, written meanwhile</source>
        <translation>版本 %1，其间被写入</translation>
    </message>
    <message>
        <source>version %1: %2</source>
        <translation>版本 %1：%2</translation>
    </message>
    <message>
        <source>the table that was written last, or a version chosen to go back to</source>
        <translation>最近一次写入的补偿表，或选定的回滚版本</translation>
    </message>
    <message>
        <source>tables before the active one on machine %1</source>
        <translation>机床 %1 上当前补偿表之前的补偿表</translation>
    </message>
    <message>
        <source>the version to go back to</source>
        <translation>回滚的目标版本</translation>
    </message>
    <message>
        <source>a former one (%1)</source>
        <translation>以前的版本之一（%1）</translation>
    </message>
    <message>
        <source>no format</source>
        <translation>无格式</translation>
    </message>
    <message>
        <source>a check sum</source>
        <translation>校验和</translation>
    </message>
    <message>
        <source>the history could not be written: %1</source>
        <translation>历史记录无法写入：%1</translation>
    </message>
    <message>
        <source>the control&apos;s backlash parameter (BACKLASH is written 0: its sign and share are not published)</source>
        <translation>控制器的反向间隙参数（BACKLASH 写为 0：其符号和所占份额未公开）</translation>
    </message>
    <message>
        <source>BACKLASH 0: its sign and share are not published</source>
        <translation>BACKLASH 为 0：其符号和所占份额未公开</translation>
    </message>
    <message>
        <source>serial %1</source>
        <translation>序列号 %1</translation>
    </message>
    <message>
        <source>the table before</source>
        <translation>之前的补偿表</translation>
    </message>
    <message>
        <source>%1 in the warm-up run</source>
        <translation>在暖机运行中%1</translation>
    </message>
    <message>
        <source>%1 in the warm-up run, so it is not proposed</source>
        <translation>在暖机运行中%1，因此不建议采用</translation>
    </message>
    <message>
        <source>stuck</source>
        <translation>卡死</translation>
    </message>
    <message>
        <source>dead</source>
        <translation>失效</translation>
    </message>
    <message>
        <source>Connection refused</source>
        <translation>连接被拒绝</translation>
    </message>
    <message>
        <source>Connection timed out</source>
        <translation>连接超时</translation>
    </message>
    <message>
        <source>Connection reset by peer</source>
        <translation>连接被对方重置</translation>
    </message>
    <message>
        <source>No route to host</source>
        <translation>没有到主机的路由</translation>
    </message>
    <message>
        <source>Network is unreachable</source>
        <translation>网络不可达</translation>
    </message>
    <message>
        <source>Host is down</source>
        <translation>主机已关闭</translation>
    </message>
    <message>
        <source>Broken pipe</source>
        <translation>连接已断开</translation>
    </message>
    <message>
        <source>Address already in use</source>
        <translation>地址已被占用</translation>
    </message>
    <message>
        <source>Temporary failure in name resolution</source>
        <translation>暂时无法解析名称</translation>
    </message>
    <message>
        <source>Name or service not known</source>
        <translation>未知的名称或服务</translation>
    </message>
    <message>
        <source>No such file or directory</source>
        <translation>没有该文件或文件夹</translation>
    </message>
    <message>
        <source>Permission denied</source>
        <translation>没有权限</translation>
    </message>
    <message>
        <source>Operation not permitted</source>
        <translation>不允许此操作</translation>
    </message>
    <message>
        <source>No space left on device</source>
        <translation>磁盘空间不足</translation>
    </message>
    <message>
        <source>Read-only file system</source>
        <translation>只读文件系统</translation>
    </message>
    <message>
        <source>Is a directory</source>
        <translation>是文件夹</translation>
    </message>
    <message>
        <source>Not a directory</source>
        <translation>不是文件夹</translation>
    </message>
    <message>
        <source>Input/output error</source>
        <translation>输入/输出错误</translation>
    </message>
    <message>
        <source>No such device</source>
        <translation>没有该设备</translation>
    </message>
    <message>
        <source>No such device or address</source>
        <translation>没有该设备或地址</translation>
    </message>
    <message>
        <source>Device or resource busy</source>
        <translation>设备或资源忙</translation>
    </message>
    <message>
        <source>Too many open files</source>
        <translation>打开的文件过多</translation>
    </message>
    <message>
        <source>Resource temporarily unavailable</source>
        <translation>资源暂时不可用</translation>
    </message>
    <message>
        <source>Operation now in progress</source>
        <translation>操作正在进行</translation>
    </message>
    <message>
        <source>Bad file descriptor</source>
        <translation>文件描述符无效</translation>
    </message>
    <message>
        <source>Invalid argument</source>
        <translation>参数无效</translation>
    </message>
    <message>
        <source>an interrupted run</source>
        <translation>一次中断的运行</translation>
    </message>
    <message>
        <source>recorded samples</source>
        <translation>已记录的采样</translation>
    </message>
    <message>
        <source>spiking</source>
        <translation>出现尖峰</translation>
    </message>
    <message>
        <source>jumped</source>
        <translation>读数跳变</translation>
    </message>
    <message>
        <source>swapped</source>
        <translation>位置互换</translation>
    </message>
    <message>
        <source>no table</source>
        <translation>无补偿表</translation>
    </message>
    <message>
        <source>axes</source>
        <translation>轴</translation>
    </message>
    <message>
        <source>controller&apos;s heartbeat</source>
        <translation>控制器心跳</translation>
    </message>
    <message>
        <source>position %1, mm</source>
        <translation>位置 %1，mm</translation>
    </message>
    <message>
        <source>position %1, degrees</source>
        <translation>位置 %1，度</translation>
    </message>
    <message>
        <source>feed %1, mm/min</source>
        <translation>进给 %1，mm/min</translation>
    </message>
    <message>
        <source>probes X1 X2 Y1 Y2 Z, um</source>
        <translation>测头 X1 X2 Y1 Y2 Z，µm</translation>
    </message>
    <message>
        <source>ramp, %</source>
        <translation>渐变，%</translation>
    </message>
    <message>
        <source>The sensors rose nearly together: a stretch with the spindle at rest separates them.</source>
        <translation>各传感器几乎同步升温：增加一段主轴静止的过程可将它们区分开。</translation>
    </message>
    <message>
        <source>%1, column spindle_rpm</source>
        <translation>%1，列 spindle_rpm</translation>
    </message>
    <message>
        <source>%1, column time_s</source>
        <translation>%1，列 time_s</translation>
    </message>
    <message>
        <source>a row each %1 s, %2 s in all</source>
        <translation>每 %1 s 一行，共 %2 s</translation>
    </message>
    <message>
        <source>seconds: a row an hour at least, 100 days at most (is it in milliseconds, or is one time wrong?)</source>
        <translation>以秒为单位，至少每小时一行，总长不超过 100 天（是否以毫秒为单位，或有一个时间错误？）</translation>
    </message>
    <message>
        <source>axis %1: up to %2 um beyond the table&apos;s own limit of %3 um are cut</source>
        <translation>轴 %1：超出补偿表自身限值 %3 um 的部分（最多 %2 um）被截去</translation>
    </message>
    <message>
        <source>parts of the region have moved apart</source>
        <translation>区域内各部分移动不一致</translation>
    </message>
    <message>
        <source>seen in part, may be a period further</source>
        <translation>仅部分可见，可能相差一个周期</translation>
    </message>
    <message>
        <source>a pixel would be %1 um: the positions do not seem to be in mm</source>
        <translation>每像素将相当于 %1 um：位置的单位似乎不是 mm</translation>
    </message>
    <message>
        <source>the region shows little but bars along y: a motion up and down (y) can hardly be seen, %1 times less well than one across</source>
        <translation>该区域几乎仅显示沿 y 的条纹：上下（y）方向的移动几乎看不出，比垂直于条纹的移动差 %1 倍</translation>
    </message>
    <message>
        <source>the region shows little but bars along x: a motion from side to side (x) can hardly be seen, %1 times less well than one across</source>
        <translation>该区域几乎仅显示沿 x 的条纹：左右（x）方向的移动几乎看不出，比垂直于条纹的移动差 %1 倍</translation>
    </message>
    <message>
        <source>the region shows little but bars %1 at %2 degrees to x: a motion along them can hardly be seen, %3 times less well than one across</source>
        <translation>该区域几乎仅显示%1、与 x 成 %2 度的条纹：沿条纹方向的移动几乎看不出，比垂直于条纹的移动差 %3 倍</translation>
    </message>
    <message>
        <source>rising to the right</source>
        <translation>向右上升</translation>
    </message>
    <message>
        <source>falling to the right</source>
        <translation>向右下降</translation>
    </message>
    <message>
        <source>choose a region or a target with structure in both directions</source>
        <translation>请选择两个方向都有结构的区域或靶标</translation>
    </message>
    <message>
        <source>%1: %2 is there already; it counts once</source>
        <translation>%1：%2 已列出，只计一次</translation>
    </message>
    <message>
        <source>%1 once more, at another position</source>
        <translation>%1 再次出现，位置却不同</translation>
    </message>
    <message>
        <source>every picture once, with the position at which it was taken</source>
        <translation>每张图片一次，并给出拍摄时的位置</translation>
    </message>
    <message>
        <source>%1: &quot;%2&quot; is no position in mm; %3 was left out</source>
        <translation>%1：“%2”不是以 mm 为单位的位置；%3 已略去</translation>
    </message>
    <message>
        <source>%1 of %2 frames lie beyond the range of the calibration, +-%3 and +-%4 px (the first is %5 at %6, %7 px): calibrate over all of the drift, or trust them less than their uncertainty says</source>
        <translation>%2 帧中有 %1 帧超出标定范围 +-%3 和 +-%4 px（首个为 %5，位于 %6、%7 px）：请在整个漂移范围内标定，否则其可信度低于所给不确定度</translation>
    </message>
    <message>
        <source>a mask of %1 pixels</source>
        <translation>%1 像素的掩膜</translation>
    </message>
    <message>
        <source>run lengths of %1x%2 pixels, the region of the target</source>
        <translation>%1x%2 像素（靶标区域）的游程长度</translation>
    </message>
    <message>
        <source>a mask that leaves nothing</source>
        <translation>未留下任何像素的掩膜</translation>
    </message>
    <message>
        <source>a mask with pixels of the target</source>
        <translation>含有靶标像素的掩膜</translation>
    </message>
    <message>
        <source>a PNG picture in base64</source>
        <translation>base64 编码的 PNG 图片</translation>
    </message>
    <message>
        <source>no base64</source>
        <translation>不是 base64</translation>
    </message>
    <message>
        <source>no picture</source>
        <translation>不是图片</translation>
    </message>
    <message>
        <source>X,Y,W,H in whole pixels, inside the picture</source>
        <translation>以整数像素表示、位于图片内的 X,Y,W,H</translation>
    </message>
    <message>
        <source>a region inside %1x%2 pixels</source>
        <translation>位于 %1x%2 像素之内的区域</translation>
    </message>
    <message>
        <source>a region of 100 megapixels at most</source>
        <translation>不超过 1 亿像素的区域</translation>
    </message>
    <message>
        <source>width and height in pixels</source>
        <translation>以像素为单位的宽和高</translation>
    </message>
    <message>
        <source>the template shows something else in the region it was made with</source>
        <translation>模板图像在其标定所用区域中显示的是别的内容</translation>
    </message>
    <message>
        <source>it stood %1 px from where it is</source>
        <translation>其位置与现在相差 %1 px</translation>
    </message>
    <message>
        <source>a number from -1e-05 to 1e-05</source>
        <translation>-1e-05 至 1e-05 之间的数</translation>
    </message>
    <message>
        <source>a number above 0, up to 1e-05</source>
        <translation>大于 0 且不超过 1e-05 的数</translation>
    </message>
    <message>
        <source>at least 2x2</source>
        <translation>至少 2x2</translation>
    </message>
    <message>
        <source>%1 to %2 um a pixel</source>
        <translation>每像素 %1 至 %2 um</translation>
    </message>
    <message>
        <source>standard uncertainties above 0</source>
        <translation>大于 0 的标准不确定度</translation>
    </message>
    <message>
        <source>other than sigma</source>
        <translation>与 sigma 不一致</translation>
    </message>
    <message>
        <source>four rows of four numbers, with the squares of sigma on the diagonal</source>
        <translation>四行、每行四个数，对角线为 sigma 的平方</translation>
    </message>
    <message>
        <source>no covariance</source>
        <translation>不是协方差</translation>
    </message>
    <message>
        <source>a symmetric matrix that is not negative</source>
        <translation>非负的对称矩阵</translation>
    </message>
    <message>
        <source>below 0</source>
        <translation>小于 0</translation>
    </message>
    <message>
        <source>two numbers of 0 or more</source>
        <translation>两个不小于 0 的数</translation>
    </message>
    <message>
        <source>the positions are too close together, or not in mm: %1 um apart, with %2 um of the machine&apos;s own the scale is known to %3 % only</source>
        <translation>各位置相距太近，或单位不是 mm：相距 %1 um，而机床自身为 %2 um，比例只能确定到 %3 %</translation>
    </message>
    <message>
        <source>the point whose displacement is measured</source>
        <translation>要测量位移的点</translation>
    </message>
    <message>
        <source>a point of %1, %2 x %3 pixels</source>
        <translation>%1 中的点（%2 x %3 像素）</translation>
    </message>
    <message>
        <source>is not in every recording</source>
        <translation>并非每次记录都有</translation>
    </message>
    <message>
        <source>%1 is not in every recording</source>
        <translation>%1 并非每次记录都有</translation>
    </message>
    <message>
        <source>%1 is not in every recording (%2)</source>
        <translation>%1 并非每次记录都有（%2 中没有）</translation>
    </message>
    <message>
        <source>an empty cell</source>
        <translation>空单元格</translation>
    </message>
    <message>
        <source>where the machine stood, in mm</source>
        <translation>机床当时的位置（mm）</translation>
    </message>
    <message>
        <source>%1: %2 of %3 samples were used, from %4 to %5 min, for nothing was measured for %6 min before or after them</source>
        <translation>%1：%3 个采样中使用了 %2 个（%4 至 %5 min），因为其前或其后有 %6 min 未进行测量</translation>
    </message>
    <message>
        <source>Nothing can be named: the simulation follows the recording only with numbers far from those described. Check the units of the recording and the sizes and powers of the description first.</source>
        <translation>无法指明任何效应：只有在参数与描述相差很大时，仿真才与记录一致。请先检查记录的单位以及描述中的尺寸和功率。</translation>
    </message>
    <message>
        <source>Recording {@what}.</source>
        <translation>记录 {@what}。</translation>
    </message>
    <message>
        <source>Recording {recording}: {@what}.</source>
        <translation>记录 {recording}：{@what}。</translation>
    </message>
    <message>
        <source>may not be in seconds: no machine tool warms so fast</source>
        <translation>可能不是以秒为单位：没有机床升温如此之快</translation>
    </message>
    <message>
        <source>%1 may not be in seconds: no machine tool warms so fast</source>
        <translation>%1 可能不是以秒为单位：没有机床升温如此之快</translation>
    </message>
    <message>
        <source>%1 may not be in seconds: no machine tool warms so fast (%2)</source>
        <translation>%1 可能不是以秒为单位：没有机床升温如此之快（%2）</translation>
    </message>
    <message>
        <source>%1 K in %2 s</source>
        <translation>%2 s 内 %1 K</translation>
    </message>
    <message>
        <source>frozen from %1 to %2 s</source>
        <translation>自 %1 至 %2 s 停滞</translation>
    </message>
    <message>
        <source>a movement of %1 um beside %2 K</source>
        <translation>变化 %1 um，而温度变化 %2 K</translation>
    </message>
    <message>
        <source>errors in um (are they in mm?)</source>
        <translation>以 um 为单位的误差（是否为 mm？）</translation>
    </message>
    <message>
        <source>errors in um (are they in nm?)</source>
        <translation>以 um 为单位的误差（是否为 nm？）</translation>
    </message>
    <message>
        <source>%1 s in all</source>
        <translation>共 %1 s</translation>
    </message>
    <message>
        <source>seconds (by %1 they are %2)</source>
        <translation>秒（按 %1 则为%2）</translation>
    </message>
    <message>
        <source>minutes</source>
        <translation>分钟</translation>
    </message>
    <message>
        <source>hours</source>
        <translation>小时</translation>
    </message>
    <message>
        <source>milliseconds</source>
        <translation>毫秒</translation>
    </message>
    <message>
        <source>a temperature that the simulation can follow</source>
        <translation>仿真可以跟随的温度</translation>
    </message>
    <message>
        <source>the check sum of this content: it was changed after it was made (make the table anew)</source>
        <translation>与此内容相符的校验和：内容在生成之后被更改（请重新生成该表）</translation>
    </message>
    <message>
        <source>Recording {recording} has no column {column}, which {other} has: it was left out.</source>
        <translation>记录 {recording} 没有 {other} 所含的列 {column}：未予采用。</translation>
    </message>
    <message>
        <source>Recording {recording} has no column {column}, which {other} has: what that switches is not simulated, and {other} may be missed for it.</source>
        <translation>记录 {recording} 没有 {other} 所含的列 {column}：其所控制的部分未被仿真，{other} 可能因此不符。</translation>
    </message>
    <message>
        <source>the same run as %1</source>
        <translation>与 %1 相同的运行</translation>
    </message>
    <message>
        <source>another run, or each run once</source>
        <translation>另一次运行，或每次运行只给一次</translation>
    </message>
    <message>
        <source>from %1 min on</source>
        <translation>自 %1 min 起</translation>
    </message>
    <message>
        <source>from %1 to %2 min</source>
        <translation>自 %1 至 %2 min</translation>
    </message>
    <message>
        <source>%1 times between %2 and %3 min</source>
        <translation>在 %2 至 %3 min 之间共 %1 次</translation>
    </message>
    <message>
        <source>the file does not exist</source>
        <translation>文件不存在</translation>
    </message>
    <message>
        <source>it is read-only</source>
        <translation>为只读</translation>
    </message>
    <message>
        <source>it may not be read</source>
        <translation>没有读取权限</translation>
    </message>
    <message>
        <source>it cannot be opened</source>
        <translation>无法打开</translation>
    </message>
    <message>
        <source>the disk gives an error</source>
        <translation>磁盘读写出错</translation>
    </message>
    <message>
        <source>entries of the job contradict one another</source>
        <translation>作业中的条目相互矛盾</translation>
    </message>
    <message>
        <source>its pages do not hold together</source>
        <translation>其内部数据页不一致</translation>
    </message>
    <message>
        <source>a part of it is missing</source>
        <translation>缺少一部分内容</translation>
    </message>
    <message>
        <source>camera %1: %2</source>
        <translation>相机 %1：%2</translation>
    </message>
    <message>
        <source>the target was found in %1 of %2 views (the first without it is %3)</source>
        <translation>%2 个视图中只在 %1 个里找到靶标（第一个未找到的是 %3）</translation>
    </message>
    <message>
        <source>the target was found in %1 of %2 views (the first without it is %3), and there the residual of %4 um rms is more than their pictures and the machine explain: what stands behind shows through; give it an even backdrop, brighter or darker than the target</source>
        <translation>%2 个视图中只在 %1 个里找到靶标（第一个未找到的是 %3），且残差 %4 um（均方根）超出图像与机床所能解释的范围：背景透入了靶标；请使用比靶标更亮或更暗的均匀背景</translation>
    </message>
    <message>
        <source>not clearly worse, and steadier where the sensors rise together</source>
        <translation>并无明显劣势，且在各传感器同步升温时更稳定</translation>
    </message>
    <message>
        <source>not clearly worse, and simpler</source>
        <translation>并无明显劣势，且更简单</translation>
    </message>
    <message>
        <source>%1 leaves %2 um rms with %3 left out; one cycle cannot rank methods, so the one that shrinks what it cannot tell is taken</source>
        <translation>%1（留出：%3）残差均方根为 %2 µm；仅一个循环无法比较各方法，因此采用会收缩无法分辨部分的方法</translation>
    </message>
    <message>
        <source>%1 leaves %2 um rms with %3 left out; with the noise of its sensors %4 um are to be expected, the least of all</source>
        <translation>%1（留出：%3）残差均方根为 %2 µm；计入其传感器噪声，预期为 %4 µm，为各方法中最小</translation>
    </message>
    <message>
        <source>%1 leaves %2 um rms with %3 left out; with the noise of their sensors %4 is to leave %5 um and this one %6 um: %7</source>
        <translation>%1（留出：%3）残差均方根为 %2 µm；计入传感器噪声，预期%4为 %5 µm，本方法为 %6 µm：%7</translation>
    </message>
    <message>
        <source>what was measured stood still while the machine moved: the region shows more of what stands still than of the target; draw it closer to the target</source>
        <translation>机床移动时所测之物静止不动：该区域显示的静止背景多于标靶；请把区域画得更贴近标靶</translation>
    </message>
    <message>
        <source>%1 is a pipe or a device, no picture, and was left out</source>
        <translation>%1 是管道或设备，不是图像，已略过</translation>
    </message>
    <message>
        <source>a file</source>
        <translation>文件</translation>
    </message>
    <message>
        <source>the PNG file is damaged</source>
        <translation>PNG 文件已损坏</translation>
    </message>
    <message>
        <source>unreadable: %1</source>
        <translation>无法读取：%1</translation>
    </message>
    <message>
        <source>larger than %1 MB</source>
        <translation>大于 %1 MB</translation>
    </message>
    <message>
        <source>a number of 0 or more</source>
        <translation>不小于 0 的数</translation>
    </message>
    <message>
        <source>-2 to 2: beyond it one end&apos;s film would be negative</source>
        <translation>-2 至 2：超出时一端的换热系数将为负</translation>
    </message>
    <message>
        <source>a share of -1 or more: -1 takes all away</source>
        <translation>不小于 -1 的份额：-1 表示全部去除</translation>
    </message>
    <message>
        <source>degrees Celsius, above absolute zero</source>
        <translation>摄氏度，高于绝对零度</translation>
    </message>
    <message>
        <source>%1: when the table was written, the machine was outside the range the model was made in</source>
        <translation>%1：写入补偿表时机床超出建模时的范围</translation>
    </message>
    <message>
        <source>the pattern goes on beyond the region and repeats itself: %1,%2,%3,%4 shows where it ends and is used</source>
        <translation>图案延伸到区域之外并且重复：改用 %1,%2,%3,%4，它包含图案的边缘</translation>
    </message>
    <message>
        <source>%1: in the verification, the machine went outside the range the model was made in</source>
        <translation>%1：验证运行中机床超出建模时的范围</translation>
    </message>
    <message>
        <source>reference: %1</source>
        <translation>参考标记：%1</translation>
    </message>
    <message>
        <source>reference %1: %2</source>
        <translation>参考标记 %1：%2</translation>
    </message>
    <message>
        <source>%1 (reference %2)</source>
        <translation>%1（参考标记 %2）</translation>
    </message>
    <message>
        <source>%1 was measured without %2</source>
        <translation>%1 在缺少以下标记时测得：%2</translation>
    </message>
    <message>
        <source>over the target&apos;s region or another mark</source>
        <translation>与靶标区域或另一标记重叠</translation>
    </message>
    <message>
        <source>a place beside them</source>
        <translation>它们旁边的位置</translation>
    </message>
    <message>
        <source>the reference mark</source>
        <translation>参考标记</translation>
    </message>
    <message>
        <source>a channel&apos;s name, for example T1_C</source>
        <translation>通道名，例如 T1_C</translation>
    </message>
    <message>
        <source>a number other than 0</source>
        <translation>非零数</translation>
    </message>
    <message>
        <source>a known unit (degC, degF, K, um, mm, inch, rpm, kW), or a scale beside it</source>
        <translation>已知单位（degC、degF、K、um、mm、inch、rpm、kW），或同时给出 scale</translation>
    </message>
    <message>
        <source>more than two</source>
        <translation>多于两列</translation>
    </message>
    <message>
        <source>one column, or date and time of day</source>
        <translation>一列，或日期与时刻两列</translation>
    </message>
    <message>
        <source>s, ms, us, ns, min, h or d</source>
        <translation>s、ms、us、ns、min、h 或 d</translation>
    </message>
    <message>
        <source>one character, tab or blanks</source>
        <translation>单个字符、tab 或 blanks</translation>
    </message>
    <message>
        <source>a workbook (.xlsx) or a text table</source>
        <translation>工作簿（.xlsx）或文本表格</translation>
    </message>
    <message>
        <source>an old Excel workbook (.xls)</source>
        <translation>旧版 Excel 工作簿（.xls）</translation>
    </message>
    <message>
        <source>a damaged archive</source>
        <translation>损坏的压缩包</translation>
    </message>
    <message>
        <source>an archive without a workbook</source>
        <translation>不含工作簿的压缩包</translation>
    </message>
    <message>
        <source>damaged XML</source>
        <translation>损坏的 XML</translation>
    </message>
    <message>
        <source>%1, scale %2</source>
        <translation>%1，比例 %2</translation>
    </message>
    <message>
        <source>may be in degrees Fahrenheit but was taken as degrees Celsius: give its unit in the column map</source>
        <translation>可能为华氏度，但已按摄氏度处理：请在列映射中给出单位</translation>
    </message>
    <message>
        <source>may be in kelvin but was taken as degrees Celsius: give its unit in the column map</source>
        <translation>可能为开尔文，但已按摄氏度处理：请在列映射中给出单位</translation>
    </message>
    <message>
        <source>%1 may be in degrees Fahrenheit but was taken as degrees Celsius: give its unit in the column map</source>
        <translation>%1 可能为华氏度，但已按摄氏度处理：请在列映射中给出单位</translation>
    </message>
    <message>
        <source>%1 may be in degrees Fahrenheit but was taken as degrees Celsius: give its unit in the column map (%2)</source>
        <translation>%1 可能为华氏度，但已按摄氏度处理：请在列映射中给出单位（%2）</translation>
    </message>
    <message>
        <source>%1 may be in kelvin but was taken as degrees Celsius: give its unit in the column map</source>
        <translation>%1 可能为开尔文，但已按摄氏度处理：请在列映射中给出单位</translation>
    </message>
    <message>
        <source>%1 may be in kelvin but was taken as degrees Celsius: give its unit in the column map (%2)</source>
        <translation>%1 可能为开尔文，但已按摄氏度处理：请在列映射中给出单位（%2）</translation>
    </message>
    <message>
        <source>Recording {recording}: the temperatures may be in degrees Fahrenheit but were taken as degrees Celsius; give their unit in the column map.</source>
        <translation>记录 {recording}：温度可能为华氏度，但已按摄氏度处理；请在列映射中给出单位。</translation>
    </message>
    <message>
        <source>Recording {recording}: the temperatures may be in kelvin but were taken as degrees Celsius; give their unit in the column map.</source>
        <translation>记录 {recording}：温度可能为开尔文，但已按摄氏度处理；请在列映射中给出单位。</translation>
    </message>
    <message>
        <source>one of a linear axis; rotary axes are not compensated</source>
        <translation>直线轴报告；不补偿旋转轴</translation>
    </message>
    <message>
        <source>of a rotary axis (column %1 is in %2)</source>
        <translation>旋转轴的文件（列 %1 的单位为 %2）</translation>
    </message>
    <message>
        <source>positions of a linear axis; rotary axes are not compensated</source>
        <translation>直线轴的位置；不补偿旋转轴</translation>
    </message>
    <message>
        <source>a report of another kind (%1)</source>
        <translation>其他类型的报告（%1）</translation>
    </message>
    <message>
        <source>a unit of length: mm, um, in, uin, mil</source>
        <translation>长度单位：mm、um、in、uin、mil</translation>
    </message>
    <message>
        <source>says whether a row counts</source>
        <translation>说明该行是否有效</translation>
    </message>
    <message>
        <source>not used: in %1</source>
        <translation>未使用：单位为 %1</translation>
    </message>
    <message>
        <source>not used: no reading</source>
        <translation>未使用：不是读数</translation>
    </message>
    <message>
        <source>not used: empty</source>
        <translation>未使用：空列</translation>
    </message>
    <message>
        <source>not used: words</source>
        <translation>未使用：文字</translation>
    </message>
    <message>
        <source>not used: a mean of other columns</source>
        <translation>未使用：其他列的平均值</translation>
    </message>
    <message>
        <source>not used: a compensation beside the readings</source>
        <translation>未使用：读数旁的补偿值</translation>
    </message>
    <message>
        <source>not used: means of both directions</source>
        <translation>未使用：双向平均值</translation>
    </message>
    <message>
        <source>not used: no positions with errors</source>
        <translation>未使用：没有带误差的位置</translation>
    </message>
    <message>
        <source>not used: the same as %1</source>
        <translation>未使用：与 %1 相同</translation>
    </message>
    <message>
        <source>the same reading as %1, compared with it</source>
        <translation>与 %1 为同一读数，已相互核对</translation>
    </message>
    <message>
        <source>a second column like %1</source>
        <translation>与 %1 同类的第二列</translation>
    </message>
    <message>
        <source>one of them</source>
        <translation>其中之一</translation>
    </message>
    <message>
        <source>numbers of unknown meaning</source>
        <translation>含义不明的数字</translation>
    </message>
    <message>
        <source>words of unknown meaning</source>
        <translation>含义不明的文字</translation>
    </message>
    <message>
        <source>a name that says what it holds</source>
        <translation>能说明内容的列名</translation>
    </message>
    <message>
        <source>no unit of length</source>
        <translation>没有长度单位</translation>
    </message>
    <message>
        <source>no unit</source>
        <translation>没有单位</translation>
    </message>
    <message>
        <source>the unit %1</source>
        <translation>单位 %1</translation>
    </message>
    <message>
        <source>one column of targets</source>
        <translation>只有一列目标位置</translation>
    </message>
    <message>
        <source>%1 beside %2 in %3</source>
        <translation>%1，而 %3 中为 %2</translation>
    </message>
    <message>
        <source>compensation values, whose sign makers do not agree on</source>
        <translation>补偿值，各厂家的符号约定不一致</translation>
    </message>
    <message>
        <source>errors, or a column map that makes them errors (scale -1)</source>
        <translation>误差，或用列映射换算为误差（scale -1）</translation>
    </message>
    <message>
        <source>no column of readings beside it</source>
        <translation>旁边没有读数列</translation>
    </message>
    <message>
        <source>a direction beside the column %1</source>
        <translation>列 %1 之外又给出方向</translation>
    </message>
    <message>
        <source>run %1 beside readings of other runs</source>
        <translation>第 %1 次测量与其他次数的读数并列</translation>
    </message>
    <message>
        <source>one way to say the run</source>
        <translation>只用一种方式说明测量次数</translation>
    </message>
    <message>
        <source>no direction</source>
        <translation>没有方向</translation>
    </message>
    <message>
        <source>a name that says the direction of its runs, as others have</source>
        <translation>像其他列那样说明测量方向的列名</translation>
    </message>
    <message>
        <source>no names above the numbers</source>
        <translation>数字上方没有列名</translation>
    </message>
    <message>
        <source>a header that names positions and errors with their units</source>
        <translation>带单位的位置和误差的表头</translation>
    </message>
    <message>
        <source>the channel of the column %1</source>
        <translation>列 %1 的通道</translation>
    </message>
    <message>
        <source>position_mm, error_um, measured_mm, direction, run or axis</source>
        <translation>position_mm、error_um、measured_mm、direction、run 或 axis</translation>
    </message>
    <message>
        <source>the unit of the column %1</source>
        <translation>列 %1 的单位</translation>
    </message>
    <message>
        <source>table at line %1</source>
        <translation>第 %1 行处的表</translation>
    </message>
    <message>
        <source>another table, with no direction above it</source>
        <translation>另一个表，其上方没有说明方向</translation>
    </message>
    <message>
        <source>a line above each table that says its direction</source>
        <translation>每个表上方有一行说明方向</translation>
    </message>
    <message>
        <source>position in %1</source>
        <translation>位置，单位 %1</translation>
    </message>
    <message>
        <source>measured position in %1</source>
        <translation>实测位置，单位 %1</translation>
    </message>
    <message>
        <source>error in %1</source>
        <translation>误差，单位 %1</translation>
    </message>
    <message>
        <source>%1, upwards</source>
        <translation>%1，正向</translation>
    </message>
    <message>
        <source>%1, downwards</source>
        <translation>%1，负向</translation>
    </message>
    <message>
        <source>%1, run %2</source>
        <translation>%1，第 %2 次</translation>
    </message>
    <message>
        <source>%1: the order of the rows tells the direction</source>
        <translation>%1：由行的顺序得出方向</translation>
    </message>
    <message>
        <source>%1: means of both directions; the file says nothing of backlash</source>
        <translation>%1：双向平均值；文件未给出反向间隙</translation>
    </message>
    <message>
        <source>%1: column %2: %3</source>
        <translation>%1：列 %2：%3</translation>
    </message>
    <message>
        <source>a word for the direction: up or down, + or -, forward or reverse</source>
        <translation>表示方向的词：up 或 down、+ 或 -、forward 或 reverse</translation>
    </message>
    <message>
        <source>the same in every row, or a file without the rows that do not count</source>
        <translation>每行相同，或不含无效行的文件</translation>
    </message>
    <message>
        <source>the direction that stands above the table</source>
        <translation>表上方给出的方向</translation>
    </message>
    <message>
        <source>%1 um where %2 says %3 um: the sign is turned</source>
        <translation>%1 um，而 %2 为 %3 um：符号相反</translation>
    </message>
    <message>
        <source>%1 um where %2 says %3 um</source>
        <translation>%1 um，而 %2 为 %3 um</translation>
    </message>
    <message>
        <source>the same reading (error = actual - target)</source>
        <translation>同一读数（误差 = 实际 - 目标）</translation>
    </message>
    <message>
        <source>%1, while the positions go the other way</source>
        <translation>%1，而位置朝相反方向变化</translation>
    </message>
    <message>
        <source>directions along the positions as they were driven</source>
        <translation>与实际移动顺序一致的方向</translation>
    </message>
    <message>
        <source>%1, which may mean either end</source>
        <translation>%1，可能指任一端</translation>
    </message>
    <message>
        <source>positions in the order they were driven, or forward and reverse</source>
        <translation>按移动顺序排列的位置，或 forward 和 reverse</translation>
    </message>
    <message>
        <source>none, and positions in no order of a drive</source>
        <translation>没有方向，且位置没有移动顺序</translation>
    </message>
    <message>
        <source>a column that says the direction of each reading</source>
        <translation>说明每个读数方向的列</translation>
    </message>
    <message>
        <source>one unit for each column</source>
        <translation>每列一个单位</translation>
    </message>
    <message>
        <source>a table of forward, backward or bidirectional errors</source>
        <translation>正向、反向或双向误差的表</translation>
    </message>
    <message>
        <source>%1: %2 of %3 readings; was the file cut?</source>
        <translation>%1：%3 个读数中只有 %2 个；文件是否不完整？</translation>
    </message>
    <message>
        <source>a line Units: um or Units: mm above the table</source>
        <translation>表上方有一行 Units: um 或 Units: mm</translation>
    </message>
    <message>
        <source>an API report in mm</source>
        <translation>以 mm 为单位的 API 报告</translation>
    </message>
    <message>
        <source>%1: errors in mm, means of several runs; confirm the sign on one point</source>
        <translation>%1：误差以 mm 为单位，为多次测量的平均值；请用一个点确认符号</translation>
    </message>
    <message>
        <source>a column of a known name (scale, type, count, sign ...), or none</source>
        <translation>已知名称的列（scale、type、count、sign 等），或没有该列</translation>
    </message>
    <message>
        <source>numbers of one kind (line %1 has %2)</source>
        <translation>同一种编号（第 %1 行为 %2）</translation>
    </message>
    <message>
        <source>%1: plain addresses are counted from 0; many lists count from 1: check one value that you know, or say --base 1</source>
        <translation>%1：普通地址按从 0 开始计数；许多列表从 1 开始：请核对一个已知的数值，或指定 --base 1</translation>
    </message>
    <message>
        <source>a register: 10, 40011, 400011, 4x00011 or %MW10</source>
        <translation>一个寄存器：10、40011、400011、4x00011 或 %MW10</translation>
    </message>
    <message>
        <source>an address of 1 or more</source>
        <translation>不小于 1 的地址</translation>
    </message>
    <message>
        <source>a number of the function in its row (%1)</source>
        <translation>与该行功能（%1）一致的编号</translation>
    </message>
    <message>
        <source>one column of a scale</source>
        <translation>只有一列比例系数</translation>
    </message>
    <message>
        <source>0: a register map has a scale and a sign, and no offset</source>
        <translation>0：寄存器映射只有比例和符号，没有偏移</translation>
    </message>
    <message>
        <source>%1, as the name says</source>
        <translation>%1，与名称一致</translation>
    </message>
    <message>
        <source>a number in the brackets, for example temperature_C[3]</source>
        <translation>方括号中的数字，例如 temperature_C[3]</translation>
    </message>
    <message>
        <source>%1[1] or %2[0] as the first element</source>
        <translation>第一个元素为 %1[1] 或 %2[0]</translation>
    </message>
    <message>
        <source>each element once, none left out</source>
        <translation>每个元素一次，不缺少</translation>
    </message>
    <message>
        <source>%1 behind element %2: an array&apos;s elements follow each other (from 0: %3)</source>
        <translation>%1 紧接元素 %2：数组元素依次相连（从 0 计：%3）</translation>
    </message>
    <message>
        <source>type, scale and the like as those of the first element</source>
        <translation>类型、比例等与第一个元素相同</translation>
    </message>
    <message>
        <source>one for each element</source>
        <translation>每个元素各一个</translation>
    </message>
    <message>
        <source>one unit number for the whole list</source>
        <translation>整个列表只有一个单元号</translation>
    </message>
    <message>
        <source>File type:</source>
        <translation>文件类型：</translation>
    </message>
    <message>
        <source>Axis position</source>
        <translation>轴位置</translation>
    </message>
    <message>
        <source>a sign or a factor in its name</source>
        <translation>列名中含符号或系数</translation>
    </message>
    <message>
        <source>actual - target in a unit; say other ones with a column map</source>
        <translation>实际 - 目标，并带单位；其他情况请用列映射说明</translation>
    </message>
    <message>
        <source>Going back to version %1</source>
        <translation>回退到版本 %1</translation>
    </message>
    <message>
        <source>roll back table</source>
        <translation>回退补偿表</translation>
    </message>
    <message>
        <source>A test move</source>
        <translation>符号检查</translation>
    </message>
    <message>
        <source>Switching the compensation on</source>
        <translation>接通补偿</translation>
    </message>
    <message>
        <source>Switching the compensation off</source>
        <translation>断开补偿</translation>
    </message>
    <message>
        <source>switch compensation</source>
        <translation>切换补偿</translation>
    </message>
    <message>
        <source>the target still moves in the picture</source>
        <translation>靶标在图像中仍在移动</translation>
    </message>
    <message>
        <source>the picture does not show the move to the measuring position</source>
        <translation>图像没有显示向测量位置的移动</translation>
    </message>
    <message>
        <source>the machine moved while it was measured</source>
        <translation>测量时机床发生了移动</translation>
    </message>
    <message>
        <source>its picture does not follow the machine</source>
        <translation>其图像不随机床移动</translation>
    </message>
    <message>
        <source>%1 shows the target %2 um from where the machine was sent, heat can make %3 um</source>
        <translation>%1 所示靶标距机床指令位置 %2 µm，热变形最多为 %3 µm</translation>
    </message>
    <message>
        <source>a measurement</source>
        <translation>测量</translation>
    </message>
    <message>
        <source>a time from 0.1 to 60 s</source>
        <translation>0.1 至 60 s 的时间</translation>
    </message>
    <message>
        <source>the plan&apos;s measuring position</source>
        <translation>计划的测量位置</translation>
    </message>
    <message>
        <source>%1 %2 mm</source>
        <translation>%1 %2 mm</translation>
    </message>
    <message>
        <source>%1 %2 mm, where the cameras were calibrated</source>
        <translation>%1 %2 mm，即标定相机的位置</translation>
    </message>
    <message>
        <source>One part warms and cools in stretches of time that no logged input explains</source>
        <translation>某一部件在若干时段内升温、降温，记录的输入均不能解释</translation>
    </message>
    <message>
        <source>The part cools faster while a logged input is on that the description does not use</source>
        <translation>当某个描述中未使用的已记录输入开启时，该部件冷却更快</translation>
    </message>
    <message>
        <source>a list of [from, to] in s, from before to</source>
        <translation>[起, 止] 列表，单位 s，起先于止</translation>
    </message>
    <message>
        <source>a report of a rotary axis</source>
        <translation>旋转轴报告</translation>
    </message>
    <message>
        <source>values other than 0 for this format</source>
        <translation>此格式中不为 0 的数值</translation>
    </message>
    <message>
        <source>X, Y or Z of a channel in um; A or B of one in urad</source>
        <translation>以 um 计的通道用 X、Y 或 Z；以 urad 计的用 A 或 B</translation>
    </message>
    <message>
        <source>axis %1, as column %2</source>
        <translation>轴 %1，与列 %2 相同</translation>
    </message>
    <message>
        <source>one column for each axis</source>
        <translation>每个轴一列</translation>
    </message>
    <message>
        <source>sensors %1</source>
        <translation>传感器 %1</translation>
    </message>
    <message>
        <source>sensors of the recording: %1</source>
        <translation>记录中的传感器：%1</translation>
    </message>
    <message>
        <source>the kind of the job is %1</source>
        <translation>作业的种类是 %1</translation>
    </message>
    <message>
        <source>a channel of the warm-up run: %1</source>
        <translation>暖机运行的通道：%1</translation>
    </message>
    <message>
        <source>the role of a recording</source>
        <translation>记录的用途</translation>
    </message>
    <message>
        <source>training, other_day or cooling</source>
        <translation>training、other_day 或 cooling</translation>
    </message>
    <message>
        <source>the job&apos;s recordings</source>
        <translation>作业中的记录</translation>
    </message>
    <message>
        <source>a time from 0.01 to 3600 s</source>
        <translation>0.01 至 3600 s 的时间</translation>
    </message>
    <message>
        <source>a map of its registers</source>
        <translation>其寄存器映射</translation>
    </message>
    <message>
        <source>a name that no other device has</source>
        <translation>其他设备未使用的名称</translation>
    </message>
    <message>
        <source>one control only; this profile has another one</source>
        <translation>只能有一个控制器；此配置文件已有另一个</translation>
    </message>
    <message>
        <source>a control: modbus-tcp, modbus-rtu or manual</source>
        <translation>控制器：modbus-tcp、modbus-rtu 或 manual</translation>
    </message>
    <message>
        <source>the id of one of the devices</source>
        <translation>某个设备的 id</translation>
    </message>
    <message>
        <source>the control: modbus-tcp, modbus-rtu or manual, here or among the devices</source>
        <translation>控制器：modbus-tcp、modbus-rtu 或 manual，写在此处或 devices 中</translation>
    </message>
    <message>
        <source>%1:%2, unit %3</source>
        <translation>%1:%2，单元 %3</translation>
    </message>
    <message>
        <source>%1, unit %2</source>
        <translation>%1，单元 %2</translation>
    </message>
    <message>
        <source>an address that is not that of %1</source>
        <translation>与 %1 不同的地址</translation>
    </message>
    <message>
        <source>the control</source>
        <translation>控制器</translation>
    </message>
    <message>
        <source>which signal of device %1 it is</source>
        <translation>设备 %1 的哪个信号</translation>
    </message>
    <message>
        <source>the id of one of the devices that are read</source>
        <translation>某个被读取的设备的 id</translation>
    </message>
    <message>
        <source>a signal that is not %1 already</source>
        <translation>尚未用于 %1 的信号</translation>
    </message>
    <message>
        <source>a channel that no other sensor has</source>
        <translation>其他传感器未使用的通道</translation>
    </message>
    <message>
        <source>the device that reads it: a manual control reads nothing</source>
        <translation>读取它的设备：人工操作的控制器不提供读数</translation>
    </message>
    <message>
        <source>signal %1</source>
        <translation>信号 %1</translation>
    </message>
    <message>
        <source>[1] to [%1]</source>
        <translation>[1] 至 [%1]</translation>
    </message>
    <message>
        <source>%1: %2 of %3 rounds were not answered</source>
        <translation>%1：%3 次查询中有 %2 次未得到应答</translation>
    </message>
    <message>
        <source>device %1 does not answer: %2</source>
        <translation>设备 %1 无应答：%2</translation>
    </message>
    <message>
        <source>displacement probes</source>
        <translation>位移测头</translation>
    </message>
    <message>
        <source>another program has the serial port</source>
        <translation>串口正被另一程序占用</translation>
    </message>
    <message>
        <source>a kind of device without a reader</source>
        <translation>没有读取程序的设备类型</translation>
    </message>
    <message>
        <source>a manual control</source>
        <translation>人工操作的控制器</translation>
    </message>
    <message>
        <source>a control with a link</source>
        <translation>有通信连接的控制器</translation>
    </message>
    <message>
        <source>the link to the control</source>
        <translation>与控制器的通信连接</translation>
    </message>
    <message>
        <source>the switch&apos;s state was not said</source>
        <translation>未说明开关状态</translation>
    </message>
    <message>
        <source>A test offset</source>
        <translation>测试偏置</translation>
    </message>
    <message>
        <source>a test offset</source>
        <translation>测试偏置</translation>
    </message>
    <message>
        <source>the control&apos;s check value</source>
        <translation>控制器的校验值</translation>
    </message>
    <message>
        <source>a table with the check value %1</source>
        <translation>校验值为 %1 的补偿表</translation>
    </message>
    <message>
        <source>reading the active table</source>
        <translation>读取当前生效的补偿表</translation>
    </message>
    <message>
        <source>going back to a former table</source>
        <translation>恢复以前的补偿表</translation>
    </message>
    <message>
        <source>another camera than before</source>
        <translation>与此前不同的相机</translation>
    </message>
    <message>
        <source>several cameras have this address</source>
        <translation>该地址有多台相机</translation>
    </message>
    <message>
        <source>camera does not take its setting</source>
        <translation>相机不接受其设置</translation>
    </message>
    <message>
        <source>pixel format of the camera is not read</source>
        <translation>相机的像素格式无法读取</translation>
    </message>
    <message>
        <source>a time from 1 to 10000000 us</source>
        <translation>1 至 10000000 us 的时间</translation>
    </message>
    <message>
        <source>a gain from -100 to 100 dB</source>
        <translation>-100 至 100 dB 的增益</translation>
    </message>
    <message>
        <source>a stream over the network</source>
        <translation>网络视频流</translation>
    </message>
    <message>
        <source>a camera at aravis: or a device; a stream is set in its camera</source>
        <translation>aravis: 相机或本机设备；视频流须在其相机中设置</translation>
    </message>
    <message>
        <source>no camera was found</source>
        <translation>未找到相机</translation>
    </message>
    <message>
        <source>found were only %1</source>
        <translation>仅找到 %1</translation>
    </message>
    <message>
        <source>another program reads it</source>
        <translation>另一程序正在读取该相机</translation>
    </message>
    <message>
        <source>exposure</source>
        <translation>曝光时间</translation>
    </message>
    <message>
        <source>gain</source>
        <translation>增益</translation>
    </message>
    <message>
        <source>the serial number</source>
        <translation>序列号</translation>
    </message>
    <message>
        <source>the exposure</source>
        <translation>曝光时间</translation>
    </message>
    <message>
        <source>the gain</source>
        <translation>增益</translation>
    </message>
    <message>
        <source>the model</source>
        <translation>型号</translation>
    </message>
    <message>
        <source>picture of the camera</source>
        <translation>相机图像</translation>
    </message>
    <message>
        <source>%1 bytes</source>
        <translation>%1 字节</translation>
    </message>
    <message>
        <source>%1 x %2 pixels</source>
        <translation>%1 x %2 像素</translation>
    </message>
    <message>
        <source>2 x 2 pixels or more</source>
        <translation>2 x 2 像素或更多</translation>
    </message>
    <message>
        <source>a register of the device&apos;s map</source>
        <translation>设备寄存器表中的寄存器</translation>
    </message>
    <message>
        <source>a name or an IP address</source>
        <translation>主机名或 IP 地址</translation>
    </message>
    <message>
        <source>a serial port such as /dev/ttyUSB0</source>
        <translation>串口，例如 /dev/ttyUSB0</translation>
    </message>
    <message>
        <source>an address of the camera</source>
        <translation>相机地址</translation>
    </message>
    <message>
        <source>another Zerodrift program, process %1, works on this controller</source>
        <translation>另一个 Zerodrift 程序（进程 %1）正在使用此控制器</translation>
    </message>
    <message>
        <source>another Zerodrift program works on this controller</source>
        <translation>另一个 Zerodrift 程序正在使用此控制器</translation>
    </message>
    <message>
        <source>end it or wait for it</source>
        <translation>请结束它或等待其完成</translation>
    </message>
    <message>
        <source>a write from here</source>
        <translation>从此处写入</translation>
    </message>
    <message>
        <source>the profile&apos;s machine</source>
        <translation>配置文件所属机床</translation>
    </message>
    <message>
        <source>serial %1, which is connected</source>
        <translation>序列号 %1（当前连接）</translation>
    </message>
    <message>
        <source>make the table anew with this machine&apos;s profile</source>
        <translation>请用本机床的配置文件重新生成补偿表</translation>
    </message>
    <message>
        <source>an axis of the table</source>
        <translation>补偿表的轴</translation>
    </message>
    <message>
        <source>one of the machine&apos;s (%1)</source>
        <translation>机床的轴之一（%1）</translation>
    </message>
    <message>
        <source>the table&apos;s limit of axis %1</source>
        <translation>补偿表中轴 %1 的限值</translation>
    </message>
    <message>
        <source>the table&apos;s rate of axis %1</source>
        <translation>补偿表中轴 %1 的速率</translation>
    </message>
    <message>
        <source>the table does not say for which machine it was made</source>
        <translation>补偿表未注明所属机床</translation>
    </message>
    <message>
        <source>the error of axis %1 at %2 mm in the axis table</source>
        <translation>轴误差表中轴 %1 在 %2 mm 处的误差</translation>
    </message>
    <message>
        <source>no answer within %1 ms</source>
        <translation>%1 ms 内无应答</translation>
    </message>
    <message>
        <source>Switching the compensation</source>
        <translation>切换补偿</translation>
    </message>
    <message>
        <source>correct table</source>
        <translation>修正补偿表</translation>
    </message>
    <message>
        <source>every %1 s instead of %2 s</source>
        <translation>每 %1 s 一次，而非每 %2 s 一次</translation>
    </message>
    <message>
        <source>there is no folder %1</source>
        <translation>文件夹 %1 不存在</translation>
    </message>
    <message>
        <source>%1 is no folder</source>
        <translation>%1 不是文件夹</translation>
    </message>
    <message>
        <source>nothing may be written into the folder %1</source>
        <translation>不允许写入文件夹 %1</translation>
    </message>
    <message>
        <source>a factor (%1) in the heading</source>
        <translation>列名中带有系数（%1）</translation>
    </message>
    <message>
        <source>a heading without one, or &quot;scale&quot; in a column map</source>
        <translation>不带系数的列名，或列映射中的 &quot;scale&quot;</translation>
    </message>
    <message>
        <source>kelvin, by their size (%1 at the start)</source>
        <translation>开尔文（按数值大小判断，起始为 %1）</translation>
    </message>
    <message>
        <source>degrees Fahrenheit, by their size (%1 at the start)</source>
        <translation>华氏度（按数值大小判断，起始为 %1）</translation>
    </message>
    <message>
        <source>a number alone, and its unit in the heading or in a row of units</source>
        <translation>仅数字，单位写在列名或单位行中</translation>
    </message>
    <message>
        <source>one order</source>
        <translation>一种次序</translation>
    </message>
    <message>
        <source>one column of an order</source>
        <translation>仅一列次序</translation>
    </message>
</context>
<context>
    <name>errors</name>
    <message>
        <source>The work was cancelled.</source>
        <translation>工作已取消。</translation>
    </message>
    <message>
        <source>What was finished until then is kept; start it again when you are ready.</source>
        <translation>此前完成的部分均已保留；准备好后可重新开始。</translation>
    </message>
    <message>
        <source>Something unexpected happened inside the program ({detail}).</source>
        <translation>程序内部发生意外（{detail}）。</translation>
    </message>
    <message>
        <source>Nothing was lost; please send the log to support.</source>
        <translation>没有数据丢失；请将日志发送给技术支持。</translation>
    </message>
    <message>
        <source>The file {file} does not exist.</source>
        <translation>文件 {file} 不存在。</translation>
    </message>
    <message>
        <source>Check the name and the folder.</source>
        <translation>请检查文件名和文件夹。</translation>
    </message>
    <message>
        <source>The file {file} cannot be read ({detail}).</source>
        <translation>无法读取文件 {file}（{detail}）。</translation>
    </message>
    <message>
        <source>Check that it is a file you may read.</source>
        <translation>请确认您有权读取该文件。</translation>
    </message>
    <message>
        <source>The file {file} cannot be written ({detail}).</source>
        <translation>无法写入文件 {file}（{detail}）。</translation>
    </message>
    <message>
        <source>Choose a folder that exists and that you may write to.</source>
        <translation>请选择一个存在且可写入的文件夹。</translation>
    </message>
    <message>
        <source>The file {file} is larger ({size} bytes) than the program accepts ({limit} bytes).</source>
        <translation>文件 {file} 的大小（{size} 字节）超过程序的上限（{limit} 字节）。</translation>
    </message>
    <message>
        <source>Cut it into shorter recordings.</source>
        <translation>请将其分成较短的记录。</translation>
    </message>
    <message>
        <source>The disk is full: {file} could not be written.</source>
        <translation>磁盘已满：无法写入 {file}。</translation>
    </message>
    <message>
        <source>Free some space; what was stored is intact.</source>
        <translation>请释放一些空间；已存储的数据完好。</translation>
    </message>
    <message>
        <source>{file} holds no rows.</source>
        <translation>{file} 中没有数据行。</translation>
    </message>
    <message>
        <source>It needs a header line and at least one line of numbers.</source>
        <translation>需要一行表头和至少一行数值。</translation>
    </message>
    <message>
        <source>{file}: column {column} of the header is &quot;{found}&quot;, expected {expected}.</source>
        <translation>{file}：表头第 {column} 列为“{found}”，应为 {expected}。</translation>
    </message>
    <message>
        <source>Correct the header or give a header map.</source>
        <translation>请更正表头，或给出表头映射。</translation>
    </message>
    <message>
        <source>{file}, line {line}: {found} cells where the header has {expected}.</source>
        <translation>{file} 第 {line} 行：有 {found} 个单元格，而表头有 {expected} 个。</translation>
    </message>
    <message>
        <source>Check the line for a missing separator or a decimal comma.</source>
        <translation>请检查该行是否缺少分隔符或使用了小数逗号。</translation>
    </message>
    <message>
        <source>{file}, line {line}, column {column}: &quot;{found}&quot; is not a number.</source>
        <translation>{file} 第 {line} 行第 {column} 列：“{found}”不是数值。</translation>
    </message>
    <message>
        <source>{file}, line {line}: the time &quot;{found}&quot; does not come after the line before.</source>
        <translation>{file} 第 {line} 行：时间“{found}”不晚于前一行。</translation>
    </message>
    <message>
        <source>{file}, line {line}, column {column}: not valid JSON ({detail}).</source>
        <translation>{file} 第 {line} 行第 {column} 列：不是有效的 JSON（{detail}）。</translation>
    </message>
    <message>
        <source>Correct the file there.</source>
        <translation>请更正文件中的该处。</translation>
    </message>
    <message>
        <source>{file}: &quot;{key}&quot; is missing; expected {expected}.</source>
        <translation>{file}：缺少“{key}”；应为 {expected}。</translation>
    </message>
    <message>
        <source>{file}: &quot;{key}&quot; is {found}; expected {expected}.</source>
        <translation>{file}：“{key}”为 {found}；应为 {expected}。</translation>
    </message>
    <message>
        <source>Correct the value.</source>
        <translation>请更正该值。</translation>
    </message>
    <message>
        <source>{file} is {found}; expected {expected}.</source>
        <translation>{file} 为 {found}；应为 {expected}。</translation>
    </message>
    <message>
        <source>Choose another file.</source>
        <translation>请选择另一个文件。</translation>
    </message>
    <message>
        <source>There is no channel {channel}; there are: {available}.</source>
        <translation>没有通道 {channel}；现有：{available}。</translation>
    </message>
    <message>
        <source>Check the name, or rename the column with a header map.</source>
        <translation>请检查名称，或用表头映射重命名该列。</translation>
    </message>
    <message>
        <source>Too little data: {what} has {found}, {needed} needed.</source>
        <translation>数据太少：{what}有 {found}，需要 {needed}。</translation>
    </message>
    <message>
        <source>Give more of it: record longer, or ask for less.</source>
        <translation>请提供更多数据：延长记录时间，或减少所选项。</translation>
    </message>
    <message>
        <source>{what} never changes, so nothing can be learned from it.</source>
        <translation>{what}始终不变，无法从中得到任何信息。</translation>
    </message>
    <message>
        <source>Check the sensor, or leave it out; a run must warm the machine.</source>
        <translation>请检查该传感器或将其略去；运行必须使机床升温。</translation>
    </message>
    <message>
        <source>{what} is &quot;{found}&quot;; expected {expected}.</source>
        <translation>{what}为“{found}”；应为 {expected}。</translation>
    </message>
    <message>
        <source>Correct it and try again.</source>
        <translation>请更正后重试。</translation>
    </message>
    <message>
        <source>{what} does not fit: found {found}, expected {expected}.</source>
        <translation>{what}不匹配：实际为 {found}，应为 {expected}。</translation>
    </message>
    <message>
        <source>The image {file} cannot be read ({detail}).</source>
        <translation>无法读取图像 {file}（{detail}）。</translation>
    </message>
    <message>
        <source>Check the file; PNG, JPEG, BMP and TIFF are accepted.</source>
        <translation>请检查该文件；可接受 PNG、JPEG、BMP 和 TIFF。</translation>
    </message>
    <message>
        <source>The image {file} is {found} pixels; the template is {expected}.</source>
        <translation>图像 {file} 为 {found} 像素；模板为 {expected}。</translation>
    </message>
    <message>
        <source>Use images from the same camera with the same settings.</source>
        <translation>请使用同一相机、相同设置拍摄的图像。</translation>
    </message>
    <message>
        <source>The region {region} is not inside the image {file} ({size}).</source>
        <translation>区域 {region} 不在图像 {file}（{size}）之内。</translation>
    </message>
    <message>
        <source>Give the region as X,Y,W,H in pixels inside the image.</source>
        <translation>请以图像内的像素给出区域 X,Y,W,H。</translation>
    </message>
    <message>
        <source>The region of the template {file} shows nothing that could be followed.</source>
        <translation>模板 {file} 的区域内没有可跟踪的特征。</translation>
    </message>
    <message>
        <source>Choose a region with the target in it; check light and focus.</source>
        <translation>请选择包含靶标的区域；检查光照和对焦。</translation>
    </message>
    <message>
        <source>The camera at {url} does not answer ({detail}).</source>
        <translation>{url} 的相机无应答（{detail}）。</translation>
    </message>
    <message>
        <source>Check that it is switched on, connected and the address is right.</source>
        <translation>请检查其是否通电、已连接且地址正确。</translation>
    </message>
    <message>
        <source>The camera at {url} has sent no picture for {seconds} s.</source>
        <translation>{url} 的相机已有 {seconds} s 未发送图像。</translation>
    </message>
    <message>
        <source>Check cable and power; the run goes on and waits for it.</source>
        <translation>请检查电缆和电源；运行继续并等待相机。</translation>
    </message>
    <message>
        <source>The camera at {url} has sent the same picture for {seconds} s: it is frozen.</source>
        <translation>{url} 的相机连续 {seconds} s 发送同一图像：画面已冻结。</translation>
    </message>
    <message>
        <source>Restart the camera; no error was measured meanwhile.</source>
        <translation>请重新启动相机；在此期间未测量误差。</translation>
    </message>
    <message>
        <source>The target was not measured: {reason}.</source>
        <translation>靶标未能测量：{reason}。</translation>
    </message>
    <message>
        <source>Clear the view, check light and focus.</source>
        <translation>请清除遮挡，检查光照和对焦。</translation>
    </message>
    <message>
        <source>The calibration is refused: {reason}.</source>
        <translation>标定被拒绝：{reason}。</translation>
    </message>
    <message>
        <source>{file} was made with another target than {template} shows ({detail}).</source>
        <translation>{file} 所用的靶标与 {template} 显示的不同（{detail}）。</translation>
    </message>
    <message>
        <source>Give the template and the region it was made with, or calibrate anew.</source>
        <translation>请给出当时所用的模板和区域，或重新标定。</translation>
    </message>
    <message>
        <source>{file} is not a Zerodrift job.</source>
        <translation>{file} 不是 Zerodrift 作业。</translation>
    </message>
    <message>
        <source>Choose a file that Zerodrift made.</source>
        <translation>请选择由 Zerodrift 创建的文件。</translation>
    </message>
    <message>
        <source>{file} was made by a newer version (format {found}, this program knows {expected}).</source>
        <translation>{file} 由更新的版本创建（格式 {found}，本程序支持到 {expected}）。</translation>
    </message>
    <message>
        <source>Update Zerodrift; the file was not touched.</source>
        <translation>请更新 Zerodrift；该文件未作改动。</translation>
    </message>
    <message>
        <source>The job {file} is damaged ({detail}).</source>
        <translation>作业 {file} 已损坏（{detail}）。</translation>
    </message>
    <message>
        <source>Open the latest backup; what can be read was left as it is.</source>
        <translation>请打开最近的备份；可读取的部分保持原样。</translation>
    </message>
    <message>
        <source>The job {file} is open in another program.</source>
        <translation>作业 {file} 已在另一程序中打开。</translation>
    </message>
    <message>
        <source>Close it there first.</source>
        <translation>请先在那里关闭。</translation>
    </message>
    <message>
        <source>The step {step} cannot run yet: it needs {needs}.</source>
        <translation>步骤“{step}”尚不能执行：需要{needs}。</translation>
    </message>
    <message>
        <source>Do that step first.</source>
        <translation>请先完成该步骤。</translation>
    </message>
    <message>
        <source>Port {port} at {host} cannot be served ({detail}).</source>
        <translation>无法在 {host} 的端口 {port} 提供服务（{detail}）。</translation>
    </message>
    <message>
        <source>Choose another port, or 0 for any free one.</source>
        <translation>请选择其他端口，或用 0 选取任一空闲端口。</translation>
    </message>
    <message>
        <source>No connection to {host}, port {port} ({detail}).</source>
        <translation>无法连接 {host} 端口 {port}（{detail}）。</translation>
    </message>
    <message>
        <source>Check cable, address and port, that the Modbus server, broker or agent there is on, and user and password where it asks for them.</source>
        <translation>请检查电缆、地址和端口，确认该处的 Modbus 服务器、MQTT 服务器或 MTConnect 代理已启用；若需要登录，请检查用户名和密码。</translation>
    </message>
    <message>
        <source>No answer came within {timeout_ms} ms ({what}).</source>
        <translation>在 {timeout_ms} ms 内无应答（{what}）。</translation>
    </message>
    <message>
        <source>Check the connection and the unit number; the link is opened anew by itself.</source>
        <translation>请检查连接和单元号；链路会自动重新建立。</translation>
    </message>
    <message>
        <source>The connection was lost ({what}, {detail}).</source>
        <translation>连接中断（{what}，{detail}）。</translation>
    </message>
    <message>
        <source>Check the cable; the link is opened anew by itself.</source>
        <translation>请检查电缆；链路会自动重新建立。</translation>
    </message>
    <message>
        <source>The answer does not belong to the question ({what}: {detail}); it was not used.</source>
        <translation>应答与请求不符（{what}：{detail}）；该应答未被采用。</translation>
    </message>
    <message>
        <source>Check the address, and look for a second master, a faulty gateway or another server in between.</source>
        <translation>请检查地址，并检查是否存在第二个主站、有故障的网关或中间的其他服务器。</translation>
    </message>
    <message>
        <source>The controller is busy ({what}).</source>
        <translation>控制器忙（{what}）。</translation>
    </message>
    <message>
        <source>The gateway got no answer from the controller behind it ({what}, Modbus exception {exception}).</source>
        <translation>网关未收到其后控制器的应答（{what}，Modbus 异常 {exception}）。</translation>
    </message>
    <message>
        <source>Check the line behind the gateway, the unit number and the gateway&apos;s own timeout; the request is repeated by itself.</source>
        <translation>请检查网关后的线路、站号以及网关自身的超时时间；请求会自动重发。</translation>
    </message>
    <message>
        <source>The controller failed at a request, or refused it ({what}, Modbus exception 4).</source>
        <translation>控制器执行请求失败或拒绝了请求（{what}，Modbus 异常 4）。</translation>
    </message>
    <message>
        <source>If it stays, look at the controller&apos;s own messages: some refuse in this way what the state of the machine forbids.</source>
        <translation>若持续出现，请查看控制器自身的消息：有些控制器以此拒绝当前机床状态所禁止的操作。</translation>
    </message>
    <message>
        <source>The controller does not have the Modbus function {function}, needed for {what}.</source>
        <translation>控制器没有 {what} 所需的 Modbus 功能码 {function}。</translation>
    </message>
    <message>
        <source>Switch it on in the controller&apos;s Modbus server. Reading may use input registers (function 4) instead of holding registers (function 3) in the register map; writing more than one register needs function 16.</source>
        <translation>请在控制器的 Modbus 服务器中启用该功能码。读取可在寄存器表中改用输入寄存器（功能码 4）代替保持寄存器（功能码 3）；一次写多个寄存器需要功能码 16。</translation>
    </message>
    <message>
        <source>The upload failed ({reason}). The old table is still active, but the compensation switch could not be turned on again ({detail}).</source>
        <translation>写入失败（{reason}）。原表仍然有效，但补偿开关未能重新打开（{detail}）。</translation>
    </message>
    <message>
        <source>The machine runs without compensation until the switch is turned on: do it at the controller, or here when the controller answers again.</source>
        <translation>在开关打开之前，机床无补偿运行：请在控制器上打开，或待控制器恢复应答后在此打开。</translation>
    </message>
    <message>
        <source>The compensation ended: {reason}. The offset is back at 0; the compensation switch is {switch}.</source>
        <translation>补偿已结束：{reason}。偏置已回到 0；补偿开关为{switch}。</translation>
    </message>
    <message>
        <source>Find the cause, then start it again.</source>
        <translation>请找出原因，然后重新启动。</translation>
    </message>
    <message>
        <source>The compensation ended ({reason}), but the machine could NOT be left as it was found ({detail}). The controller holds this offset: {held}; the compensation switch is {switch}.</source>
        <translation>补偿已结束（{reason}），但机床未能恢复原状（{detail}）。控制器中的偏置为：{held}；补偿开关为{switch}。</translation>
    </message>
    <message>
        <source>Do not machine parts. Look at the offset at the controller and switch its compensation off; a watchdog in the controller takes the offset out by itself.</source>
        <translation>请勿加工零件。请在控制器上查看偏置并关闭其补偿；控制器中的看门狗会自行撤除偏置。</translation>
    </message>
    <message>
        <source>Wait a little and try again.</source>
        <translation>请稍候再试。</translation>
    </message>
    <message>
        <source>The controller refused {what} (Modbus exception {exception}).</source>
        <translation>控制器拒绝了 {what}（Modbus 异常 {exception}）。</translation>
    </message>
    <message>
        <source>Check the register map against the controller&apos;s manual.</source>
        <translation>请对照控制器手册检查寄存器映射。</translation>
    </message>
    <message>
        <source>The controller or device does not fit: {what} is {found}, expected {expected}.</source>
        <translation>控制器或设备不匹配：{what}为 {found}，应为 {expected}。</translation>
    </message>
    <message>
        <source>Check the profile, the register map and the device&apos;s own settings.</source>
        <translation>请检查配置文件、寄存器映射以及设备自身的设置。</translation>
    </message>
    <message>
        <source>The register map {map} has no register &quot;{register}&quot;.</source>
        <translation>寄存器映射 {map} 中没有寄存器“{register}”。</translation>
    </message>
    <message>
        <source>Add it to the map, or switch off the function that needs it.</source>
        <translation>请将其加入映射，或关闭需要它的功能。</translation>
    </message>
    <message>
        <source>The machine is not ready for {what}: {reason}.</source>
        <translation>机床尚未就绪，不能进行{what}：{reason}。</translation>
    </message>
    <message>
        <source>Put it right and try again.</source>
        <translation>请排除后重试。</translation>
    </message>
    <message>
        <source>The target before camera {view} is partly occluded: {percent} % of it is measured.</source>
        <translation>相机 {view} 前的靶标被部分遮挡：仅测得其 {percent} %。</translation>
    </message>
    <message>
        <source>The numbers hold, with their uncertainty; wipe the target at the next stop.</source>
        <translation>数值及其不确定度仍然有效；请在下次停机时擦拭靶标。</translation>
    </message>
    <message>
        <source>The temperature sensor {sensor} gives no value.</source>
        <translation>温度传感器 {sensor} 没有数值。</translation>
    </message>
    <message>
        <source>Check its plug and cable, or leave it out of the model.</source>
        <translation>请检查其插头和电缆，或不将其用于模型。</translation>
    </message>
    <message>
        <source>The temperature sensor {sensor} has not moved for {seconds} s: it is stuck.</source>
        <translation>温度传感器 {sensor} 已有 {seconds} s 没有变化：疑似卡死。</translation>
    </message>
    <message>
        <source>Check it, or leave it out of the model.</source>
        <translation>请检查该传感器，或不将其用于模型。</translation>
    </message>
    <message>
        <source>Not allowed while the compensation is ON: {operation}.</source>
        <translation>补偿接通时不允许：{operation}。</translation>
    </message>
    <message>
        <source>Switch the compensation off first; data measured with it on would be wrong.</source>
        <translation>请先断开补偿；补偿接通时测得的数据是错误的。</translation>
    </message>
    <message>
        <source>Not allowed while the compensation is OFF: {operation}.</source>
        <translation>补偿断开时不允许：{operation}。</translation>
    </message>
    <message>
        <source>Switch the compensation on first.</source>
        <translation>请先接通补偿。</translation>
    </message>
    <message>
        <source>{what} is {found}, beyond the limit of {limit}.</source>
        <translation>{what}为 {found}，超出限值 {limit}。</translation>
    </message>
    <message>
        <source>Nothing was written; check the model or the limit.</source>
        <translation>未写入任何内容；请检查模型或限值。</translation>
    </message>
    <message>
        <source>{operation} was not confirmed; nothing was written.</source>
        <translation>{operation}未经确认；未写入任何内容。</translation>
    </message>
    <message>
        <source>Confirm it, or use --yes.</source>
        <translation>请确认，或使用 --yes。</translation>
    </message>
    <message>
        <source>Register {register} reads back {read} instead of {written}.</source>
        <translation>寄存器 {register} 回读为 {read}，写入值为 {written}。</translation>
    </message>
    <message>
        <source>Nothing was activated; check the link and the register map.</source>
        <translation>未激活任何内容；请检查链路和寄存器映射。</translation>
    </message>
    <message>
        <source>The controller rejected the table: {reason}.</source>
        <translation>控制器拒绝了补偿表：{reason}。</translation>
    </message>
    <message>
        <source>Nothing was activated; the old table is active.</source>
        <translation>未激活任何内容；旧表仍然有效。</translation>
    </message>
    <message>
        <source>The upload failed ({reason}); the old table was restored and read back.</source>
        <translation>上传失败（{reason}）；旧表已恢复并回读。</translation>
    </message>
    <message>
        <source>Find the cause, then upload again.</source>
        <translation>请查明原因后重新上传。</translation>
    </message>
    <message>
        <source>The upload failed ({reason}) AND the old table could not be restored ({detail}). The machine&apos;s table is not known.</source>
        <translation>上传失败（{reason}），且旧表无法恢复（{detail}）。机床中的补偿表状态未知。</translation>
    </message>
    <message>
        <source>Do not machine parts. Switch the compensation off at the controller, then use rollback.</source>
        <translation>请勿加工工件。请在控制器上断开补偿，然后使用回滚。</translation>
    </message>
    <message>
        <source>The sign check failed on axis {axis}: commanded {commanded_um} um, seen in um: {seen_um}.</source>
        <translation>轴 {axis} 的符号检查未通过：指令 {commanded_um} µm，观测（µm）：{seen_um}。</translation>
    </message>
    <message>
        <source>Nothing was written; check the axis direction and the calibration.</source>
        <translation>未写入任何内容；请检查轴的方向和标定。</translation>
    </message>
    <message>
        <source>The temperature sensor {sensor} shows spikes ({count} lately).</source>
        <translation>温度传感器 {sensor} 出现尖峰（近期 {count} 次）。</translation>
    </message>
    <message>
        <source>Check its plug and the shield of its cable; the spikes are left out of the fit.</source>
        <translation>请检查其插头和电缆屏蔽；拟合时不采用这些尖峰。</translation>
    </message>
    <message>
        <source>The temperature sensor {sensor} jumped by {kelvin} K from one reading to the next.</source>
        <translation>温度传感器 {sensor} 的相邻两次读数跳变 {kelvin} K。</translation>
    </message>
    <message>
        <source>Check whether it came loose or was plugged in elsewhere, or leave it out of the model.</source>
        <translation>请检查它是否松脱或插到了别处，或不将其用于模型。</translation>
    </message>
    <message>
        <source>The temperature sensors {sensor} and {other} have changed places.</source>
        <translation>温度传感器 {sensor} 与 {other} 的位置互换了。</translation>
    </message>
    <message>
        <source>Plug them back; what was recorded since belongs to the other one.</source>
        <translation>请将插头换回；此后记录的数据属于另一个传感器。</translation>
    </message>
    <message>
        <source>{operation} needs the engineer: this computer is locked and may only read from machines.</source>
        <translation>{operation} 需要工程师权限：本机已锁定，只能读取机床数据。</translation>
    </message>
    <message>
        <source>Unlock it with the engineer&apos;s PIN (the lock at the bottom of the window, or --pin-file).</source>
        <translation>请用工程师 PIN 解锁（窗口底部的锁形按钮，或 --pin-file）。</translation>
    </message>
    <message>
        <source>The PIN is not right.</source>
        <translation>PIN 不正确。</translation>
    </message>
    <message>
        <source>Try again; it is the one that was set on this computer.</source>
        <translation>请重试；应输入在本机上设置的 PIN。</translation>
    </message>
    <message>
        <source>Too many wrong PINs: the next try counts in {seconds} s.</source>
        <translation>PIN 错误次数过多：{seconds} s 后才能再试。</translation>
    </message>
    <message>
        <source>Wait, then try again.</source>
        <translation>请稍候再试。</translation>
    </message>
    <message>
        <source>The PIN must have {least} to {most} characters.</source>
        <translation>PIN 应为 {least} 至 {most} 个字符。</translation>
    </message>
    <message>
        <source>Choose another one.</source>
        <translation>请另选一个。</translation>
    </message>
    <message>
        <source>The job names a file of another computer: {key} is &quot;{found}&quot;. It was not read.</source>
        <translation>作业引用了另一台计算机上的文件：{key} 为“{found}”。未读取该文件。</translation>
    </message>
    <message>
        <source>Load the machine&apos;s connection profile again; the job then holds what it needs.</source>
        <translation>请重新载入机床的连接配置；之后作业即包含所需内容。</translation>
    </message>
    <message>
        <source>Add this entry, if it is the right file.</source>
        <translation>如果文件选择正确，请补上此项。</translation>
    </message>
    <message>
        <source>The machine does not hold version {version}, the table of this job: it holds {found}.</source>
        <translation>机床中不是本作业的补偿表版本 {version}，而是：{found}。</translation>
    </message>
    <message>
        <source>Write it, or bring it back in the history, then verify.</source>
        <translation>请写入该表或从历史记录中恢复，然后再验证。</translation>
    </message>
    <message>
        <source>Check the units, and that all of it is of one machine.</source>
        <translation>请检查单位，以及各项数据是否属于同一台机床。</translation>
    </message>
    <message>
        <source>Look at what is named; positions are in mm, apart and not on one line, each with its own picture.</source>
        <translation>请检查所指出的问题；各位置以 mm 为单位，彼此分开且不在一条直线上，每个位置各有一幅图像。</translation>
    </message>
    <message>
        <source>The pattern of {file} repeats itself beyond the region: one period further it looks the same, and a shift by one period could not be told from none.</source>
        <translation>{file} 的图案在区域之外继续重复：移过一个周期看上去完全相同，无法区分移动了一个周期与没有移动。</translation>
    </message>
    <message>
        <source>Choose a region with the edge of the pattern or a mark in it.</source>
        <translation>请选择包含图案边缘或标记的区域。</translation>
    </message>
    <message>
        <source>The measurement goes on with the other mark and a larger uncertainty; wipe the mark, or take away what covers it.</source>
        <translation>测量以另一标记继续进行，不确定度增大；请擦净标记，或移开遮挡物。</translation>
    </message>
    <message>
        <source>A reference mark is not seen: {reason}.</source>
        <translation>有一个参考标记未被识别：{reason}。</translation>
    </message>
    <message>
        <source>{file}, line {line}: there are bytes that mean nothing in {encoding}.</source>
        <translation>{file} 第 {line} 行：有字节不属于编码 {encoding}。</translation>
    </message>
    <message>
        <source>Save the file as UTF-8, or say its &quot;encoding&quot; in a header map.</source>
        <translation>请将文件另存为 UTF-8，或在列名映射中写明 &quot;encoding&quot;。</translation>
    </message>
    <message>
        <source>{file}, line {line}: a quotation mark opens and never closes.</source>
        <translation>{file} 第 {line} 行：引号未闭合。</translation>
    </message>
    <message>
        <source>Close it or take it out.</source>
        <translation>请闭合或删除该引号。</translation>
    </message>
    <message>
        <source>{file}, line {line}, column {column}: &quot;{found}&quot; may have a decimal comma or group thousands, and no other number in the file decides it.</source>
        <translation>{file} 第 {line} 行，列 {column}：&quot;{found}&quot; 中的逗号可能是小数点，也可能是千位分隔符，文件中没有其他数字可以判定。</translation>
    </message>
    <message>
        <source>Say &quot;decimal&quot;: &quot;,&quot; or &quot;decimal&quot;: &quot;.&quot; in a header map.</source>
        <translation>请在列名映射中写明 &quot;decimal&quot;: &quot;,&quot; 或 &quot;decimal&quot;: &quot;.&quot;。</translation>
    </message>
    <message>
        <source>{file}, line {line}, column {column}: &quot;{found}&quot; and &quot;{other}&quot; (line {other_line}) do not have the same decimal sign.</source>
        <translation>{file} 第 {line} 行，列 {column}：&quot;{found}&quot; 与 &quot;{other}&quot;（第 {other_line} 行）的小数点写法不一致。</translation>
    </message>
    <message>
        <source>Write one of them otherwise, or say &quot;decimal&quot; in a header map.</source>
        <translation>请改写其中之一，或在列名映射中写明 &quot;decimal&quot;。</translation>
    </message>
    <message>
        <source>Save each in a file of its own.</source>
        <translation>请将每个表单独存为一个文件。</translation>
    </message>
    <message>
        <source>{file}, line {line}: the header stands here again.</source>
        <translation>{file} 第 {line} 行：表头在此重复出现。</translation>
    </message>
    <message>
        <source>The rows after it are read on.</source>
        <translation>其后的行继续读取。</translation>
    </message>
    <message>
        <source>{file}, line {line}: &quot;{found}&quot; is no row of the table and was passed over.</source>
        <translation>{file} 第 {line} 行：&quot;{found}&quot; 不是表中的数据行，已跳过。</translation>
    </message>
    <message>
        <source>Correct the line if it should be one.</source>
        <translation>若它应为数据行，请更正该行。</translation>
    </message>
    <message>
        <source>{file} has no header: line {line}, its first, holds numbers.</source>
        <translation>{file} 没有表头：首行（第 {line} 行）即为数字。</translation>
    </message>
    <message>
        <source>Name its columns by their places, #1, #2 and so on, under &quot;columns&quot; in a header map (--map).</source>
        <translation>请在列名映射（--map）的 &quot;columns&quot; 下按位置 #1、#2 等命名各列。</translation>
    </message>
    <message>
        <source>{file} has no column &quot;{column}&quot;, which the header map names; there are: {available}.</source>
        <translation>{file} 中没有列名映射所指的列 &quot;{column}&quot;；现有列：{available}。</translation>
    </message>
    <message>
        <source>Correct the header map; a column may also be named by its place, for example #3.</source>
        <translation>请更正列名映射；也可按位置指定列，例如 #3。</translation>
    </message>
    <message>
        <source>{file}, column {column}: the values are in {found}, which does not agree with {expected}.</source>
        <translation>{file}，列 {column}：数值单位为 {found}，与 {expected} 不符。</translation>
    </message>
    <message>
        <source>Correct the unit, the scale or the channel in the header map.</source>
        <translation>请在列名映射中更正单位、比例或通道。</translation>
    </message>
    <message>
        <source>{file} has no column of times; there are: {available}.</source>
        <translation>{file} 没有时间列；现有列：{available}。</translation>
    </message>
    <message>
        <source>Name it under &quot;time&quot; in a header map (--map): its &quot;column&quot; and its &quot;unit&quot;.</source>
        <translation>请在列名映射（--map）的 &quot;time&quot; 下指明其 &quot;column&quot; 与 &quot;unit&quot;。</translation>
    </message>
    <message>
        <source>{file}, column {column}: the times ({found} first) say no unit.</source>
        <translation>{file}，列 {column}：时间（首个为 {found}）未注明单位。</translation>
    </message>
    <message>
        <source>Give &quot;unit&quot; under &quot;time&quot; in a header map (--map): s, ms, us, ns, min, h or d.</source>
        <translation>请在列名映射（--map）的 &quot;time&quot; 下给出 &quot;unit&quot;：s、ms、us、ns、min、h 或 d。</translation>
    </message>
    <message>
        <source>{file}, line {line}, column {column}: in &quot;{found}&quot; day, month and year may be in more than one order.</source>
        <translation>{file} 第 {line} 行，列 {column}：&quot;{found}&quot; 中年、月、日的次序不唯一。</translation>
    </message>
    <message>
        <source>Give &quot;format&quot; under &quot;time&quot; in a header map (--map), for example %d/%m/%Y %H:%M:%S.</source>
        <translation>请在列名映射（--map）的 &quot;time&quot; 下给出 &quot;format&quot;，例如 %d/%m/%Y %H:%M:%S。</translation>
    </message>
    <message>
        <source>{file}, line {line}, column {column}: &quot;{found}&quot; is no time of the form the column has.</source>
        <translation>{file} 第 {line} 行，列 {column}：&quot;{found}&quot; 不符合该列的时间格式。</translation>
    </message>
    <message>
        <source>Correct the line, or give &quot;format&quot; under &quot;time&quot; in a header map (--map), for example %d.%m.%Y %H:%M:%S.</source>
        <translation>请更正该行，或在列名映射（--map）的 &quot;time&quot; 下给出 &quot;format&quot;，例如 %d.%m.%Y %H:%M:%S。</translation>
    </message>
    <message>
        <source>The times in column {column} are {unit} since 1970, by their size; the recording starts {start}.</source>
        <translation>列 {column} 中的时间按数值大小判定为自 1970 年起的 {unit}；记录始于 {start}。</translation>
    </message>
    <message>
        <source>If they are not, give the unit in a header map.</source>
        <translation>若不正确，请在列名映射中给出单位。</translation>
    </message>
    <message>
        <source>In column {column} &quot;{found}&quot; may be more than one date; times do not depend on it, and no date is kept.</source>
        <translation>列 {column} 中的 &quot;{found}&quot; 可能对应多个日期；时间不受影响，日期未保留。</translation>
    </message>
    <message>
        <source>Give the format in a header map to keep the date.</source>
        <translation>若需保留日期，请在列名映射中给出格式。</translation>
    </message>
    <message>
        <source>{file}, line {line}: the local clock goes back by an hour, as at the end of summer time.</source>
        <translation>{file} 第 {line} 行：本地时钟回拨一小时，应为夏令时结束。</translation>
    </message>
    <message>
        <source>The rows from there on count an hour later; correct the file if the clock was set for another reason.</source>
        <translation>其后各行按晚一小时计；若时钟因其他原因被调整，请更正文件。</translation>
    </message>
    <message>
        <source>{file}, line {line}: an hour is missing, as at the beginning of summer time.</source>
        <translation>{file} 第 {line} 行：缺少一小时，可能为夏令时开始。</translation>
    </message>
    <message>
        <source>It counts as a gap; give times with a zone if the clock was set forward.</source>
        <translation>按间断处理；若时钟被拨快，请提供带时区的时间。</translation>
    </message>
    <message>
        <source>{file}, line {line}: the time of day starts again; a day is counted on.</source>
        <translation>{file} 第 {line} 行：一天中的时刻重新开始；按次日计。</translation>
    </message>
    <message>
        <source>Give a column with dates if it was more than one day.</source>
        <translation>若间隔超过一天，请提供日期列。</translation>
    </message>
    <message>
        <source>{file}: {count} rows repeat the row before them word for word, the first in line {line}; they were left out.</source>
        <translation>{file}：有 {count} 行与前一行完全相同，首个在第 {line} 行；已略去。</translation>
    </message>
    <message>
        <source>Nothing need be done.</source>
        <translation>无需处理。</translation>
    </message>
    <message>
        <source>Column {column}: read as missing samples: {words}.</source>
        <translation>列 {column}：以下按缺失样本读取：{words}。</translation>
    </message>
    <message>
        <source>Check the sensor if they should be there.</source>
        <translation>若应有数据，请检查传感器。</translation>
    </message>
    <message>
        <source>Column {column} was read as {channel}; it may be {proposal}.</source>
        <translation>列 {column} 读作 {channel}；可能应为 {proposal}。</translation>
    </message>
    <message>
        <source>Say so in a header map if it is.</source>
        <translation>若是，请在列名映射中写明。</translation>
    </message>
    <message>
        <source>Column {column} states {unit}; it was converted into {channel}.</source>
        <translation>列 {column} 注明单位为 {unit}；已换算为 {channel}。</translation>
    </message>
    <message>
        <source>Give the unit in a header map if that is wrong.</source>
        <translation>若有误，请在列名映射中给出单位。</translation>
    </message>
    <message>
        <source>Column {column} holds {found} in {count} rows, which may stand for a missing sample.</source>
        <translation>列 {column} 有 {count} 行为 {found}，可能表示缺失样本。</translation>
    </message>
    <message>
        <source>If so, add it to &quot;missing&quot; in a header map.</source>
        <translation>若是，请将其加入列名映射的 &quot;missing&quot;。</translation>
    </message>
    <message>
        <source>{file}, row {line}, column {column}: the formula there has no value.</source>
        <translation>{file} 第 {line} 行，第 {column} 列：该处公式没有数值。</translation>
    </message>
    <message>
        <source>Open the workbook in a spreadsheet program, save it, and import it again.</source>
        <translation>请用电子表格程序打开并保存该工作簿，然后重新导入。</translation>
    </message>
    <message>
        <source>Correct it; if the sample is missing, leave the cell empty or add the word to &quot;missing&quot; in a header map (--map).</source>
        <translation>请更正；若样本缺失，请将单元格留空，或将该词加入列名映射（--map）的 &quot;missing&quot;。</translation>
    </message>
    <message>
        <source>Times must be there in every line and increase: correct the order of the lines, or take the line out.</source>
        <translation>每行都必须有时间且递增：请更正行的次序，或删除该行。</translation>
    </message>
    <message>
        <source>Correct it there, or say with a column map (--map) what the column holds.</source>
        <translation>请在该处更正，或用列映射（--map）说明该列的内容。</translation>
    </message>
    <message>
        <source>Neither the plan nor the profile says where the errors are measured: the position of {axes} is missing.</source>
        <translation>计划和配置都没有说明在哪里测量误差：缺少 {axes} 的位置。</translation>
    </message>
    <message>
        <source>Give measure_position_mm in the plan or in the profile.</source>
        <translation>请在计划或配置中给出 measure_position_mm。</translation>
    </message>
    <message>
        <source>A measurement takes longer than its period: the errors are measured every {every_s} s instead of every {period_s} s.</source>
        <translation>一次测量所需的时间超过测量周期：误差每 {every_s} s 测量一次，而不是每 {period_s} s。</translation>
    </message>
    <message>
        <source>The run goes on; close other programs on this computer, or choose a longer measuring period.</source>
        <translation>运行继续；请关闭本计算机上的其他程序，或选择更长的测量周期。</translation>
    </message>
    <message>
        <source>At this pace the run will end with {expected} good measurements, at least {needed} are needed.</source>
        <translation>按目前的速度，运行结束时只有 {expected} 次有效测量，至少需要 {needed} 次。</translation>
    </message>
    <message>
        <source>Look at why measurements are refused or slow, then start again: close other programs on this computer, clear the view, or plan a longer run.</source>
        <translation>请查明测量被拒绝或变慢的原因，然后重新开始：关闭本计算机上的其他程序、清理视野，或计划更长的运行。</translation>
    </message>
    <message>
        <source>The error in {axis} leapt by {change_um} um since the last measurement; heat can make at most {limit_um} um of it. The measurement was refused.</source>
        <translation>{axis} 方向的误差自上次测量以来跳变了 {change_um} um，而热变形最多只能造成 {limit_um} um。该测量被拒绝。</translation>
    </message>
    <message>
        <source>Check that the target is firm in its holder and that nothing moves the machine; a leap that is found three times in a row is taken as a slip.</source>
        <translation>请检查靶标是否固定牢靠、是否有其他原因使机床移动；连续三次出现的跳变按靶标滑移处理。</translation>
    </message>
    <message>
        <source>The error in {axis} leapt by {change_um} um and stayed there: the target or its holder has slipped. The measurements since contain that leap.</source>
        <translation>{axis} 方向的误差跳变了 {change_um} um 并保持不变：靶标或其支架发生了滑移。此后的测量包含这一跳变。</translation>
    </message>
    <message>
        <source>Fix the target and repeat the run, or leave this part of the run out of the fit.</source>
        <translation>请固定靶标并重新运行，或在拟合时排除这一段。</translation>
    </message>
    <message>
        <source>The pictures of camera {view} were older than was known when it was calibrated; {seconds} s are waited for now.</source>
        <translation>相机 {view} 的图像比标定时已知的更旧；现在等待 {seconds} s。</translation>
    </message>
    <message>
        <source>The measurements hold. Check the camera&apos;s network, or calibrate anew.</source>
        <translation>测量有效。请检查相机的网络，或重新标定。</translation>
    </message>
    <message>
        <source>{file} holds two tables: one at line {line}, one at line {other_line}.</source>
        <translation>{file} 含有两个表：一个在第 {line} 行，另一个在第 {other_line} 行。</translation>
    </message>
    <message>
        <source>{file}, line {line}, column {column}: found {found}; expected {expected}.</source>
        <translation>{file} 第 {line} 行 {column} 列：内容为 {found}；应为 {expected}。</translation>
    </message>
    <message>
        <source>Correct the header, or import the file and say in the table what it is.</source>
        <translation>请更正表头，或导入该文件并在表格中说明其含义。</translation>
    </message>
    <message>
        <source>Correct it; if the sample is missing, leave the cell empty or enter the word under Missing in the import dialog.</source>
        <translation>请更正；若样本缺失，请将单元格留空，或在导入对话框的“缺失”中填入该词。</translation>
    </message>
    <message>
        <source>Correct it in the file, or say what the column holds where the columns are asked.</source>
        <translation>请在文件中更正，或在询问各列时说明该列的内容。</translation>
    </message>
    <message>
        <source>Save the file as UTF-8 and import it again.</source>
        <translation>请将文件另存为 UTF-8 后重新导入。</translation>
    </message>
    <message>
        <source>Choose the decimal sign in the import dialog.</source>
        <translation>请在导入对话框中选择小数符号。</translation>
    </message>
    <message>
        <source>Write one of them otherwise, or choose the decimal sign in the import dialog.</source>
        <translation>请改写其中一个，或在导入对话框中选择小数符号。</translation>
    </message>
    <message>
        <source>Say for each column in the table of the import dialog what it is.</source>
        <translation>请在导入对话框的表格中逐列说明其含义。</translation>
    </message>
    <message>
        <source>Load another map, or say in the table what the columns are.</source>
        <translation>请载入另一份列名映射，或在表格中说明各列的含义。</translation>
    </message>
    <message>
        <source>Correct what the column is, its unit or its scale, in its row of the table.</source>
        <translation>请在表格中该列所在的行更正其类型、单位或比例。</translation>
    </message>
    <message>
        <source>Choose &quot;time&quot; for the column that holds it, in its row of the table.</source>
        <translation>请在表格中存放时间的列所在的行选择“时间”。</translation>
    </message>
    <message>
        <source>Choose the unit of the times in the row of that column.</source>
        <translation>请在该列所在的行选择时间的单位。</translation>
    </message>
    <message>
        <source>Enter the format in the row of that column, for example %d/%m/%Y %H:%M:%S.</source>
        <translation>请在该列所在的行填入格式，例如 %d/%m/%Y %H:%M:%S。</translation>
    </message>
    <message>
        <source>Correct the line, or enter the format in the row of that column, for example %d.%m.%Y %H:%M:%S.</source>
        <translation>请更正该行数据，或在该列所在的行填入格式，例如 %d.%m.%Y %H:%M:%S。</translation>
    </message>
    <message>
        <source>If they are not, choose the unit in the row of that column.</source>
        <translation>若不是，请在该列所在的行选择单位。</translation>
    </message>
    <message>
        <source>Enter the format in the row of that column to keep the date.</source>
        <translation>若要保留日期，请在该列所在的行填入格式。</translation>
    </message>
    <message>
        <source>Choose it in the row of that column if it is.</source>
        <translation>若是，请在该列所在的行选择它。</translation>
    </message>
    <message>
        <source>Choose another unit in the row of that column if that is wrong.</source>
        <translation>若有误，请在该列所在的行选择其他单位。</translation>
    </message>
    <message>
        <source>If so, enter it under Missing in the import dialog.</source>
        <translation>若是，请在导入对话框的“缺失”中填入它。</translation>
    </message>
    <message>
        <source>Check the name, or import the file again with the channel&apos;s name.</source>
        <translation>请检查名称，或重新导入文件并使用该通道名称。</translation>
    </message>
    <message>
        <source>Device {device} does not answer, its values are missing: {reason}.</source>
        <translation>设备 {device} 无应答，其数值缺失：{reason}。</translation>
    </message>
    <message>
        <source>Check its power, its cable and its address; it is asked again by itself.</source>
        <translation>请检查其电源、电缆和地址；程序会自动再次查询。</translation>
    </message>
    <message>
        <source>The control of this machine has no link, and nobody is here to operate it.</source>
        <translation>这台机床的控制器没有通信连接，也没有人在操作它。</translation>
    </message>
    <message>
        <source>Start this on a terminal, or give &quot;--operator -&quot; and answer each line.</source>
        <translation>请在终端上启动，或使用“--operator -”并逐行应答。</translation>
    </message>
    <message>
        <source>The operator could not do &quot;{request}&quot;: {reason}.</source>
        <translation>操作员无法执行“{request}”：{reason}。</translation>
    </message>
    <message>
        <source>Put it right at the control and start the step again.</source>
        <translation>请在控制器上排除问题，然后重新开始此步骤。</translation>
    </message>
    <message>
        <source>The operator does not answer any more.</source>
        <translation>操作员不再应答。</translation>
    </message>
    <message>
        <source>Bring the machine to rest at its control, then start the step again.</source>
        <translation>请在控制器上使机床停止，然后重新开始此步骤。</translation>
    </message>
    <message>
        <source>The camera at {url} has the serial number {found}; it was {expected} before.</source>
        <translation>{url} 的相机序列号为 {found}；此前为 {expected}。</translation>
    </message>
    <message>
        <source>Connect the camera that was there before, or connect anew and calibrate.</source>
        <translation>请接回此前的相机，或重新连接并标定。</translation>
    </message>
    <message>
        <source>{url} does not say which camera: those with the serial numbers {found} are there.</source>
        <translation>{url} 未指明是哪台相机：现有序列号为 {found} 的相机。</translation>
    </message>
    <message>
        <source>Write the serial number of one of them into the profile: aravis:SERIAL.</source>
        <translation>请将其中一台的序列号写入连接配置：aravis:SERIAL。</translation>
    </message>
    <message>
        <source>The camera at {url} does not take {what} {expected} ({found}).</source>
        <translation>{url} 的相机不接受{what} {expected}（{found}）。</translation>
    </message>
    <message>
        <source>Write a value that the camera has into the profile, or remove the key.</source>
        <translation>请在连接配置中填写相机支持的值，或删除该键。</translation>
    </message>
    <message>
        <source>The camera at {url} sends pictures as {found}, which is not read.</source>
        <translation>{url} 的相机以 {found} 格式发送图像，无法读取。</translation>
    </message>
    <message>
        <source>Set the camera to one of the formats {expected} or another grey or Bayer format.</source>
        <translation>请将相机设为 {expected} 或其他灰度或 Bayer 格式。</translation>
    </message>
    <message>
        <source>Camera {camera} was calibrated with {what} {expected}; now it is {found}.</source>
        <translation>相机 {camera} 标定时{what}为 {expected}；现在为 {found}。</translation>
    </message>
    <message>
        <source>Put it back as it was calibrated, or calibrate anew.</source>
        <translation>请恢复标定时的状态，或重新标定。</translation>
    </message>
</context>
<context>
    <name>happenings</name>
    <message>
        <source>gap in the recording</source>
        <translation>记录出现间断</translation>
    </message>
    <message>
        <source>recording interrupted</source>
        <translation>记录中断</translation>
    </message>
    <message>
        <source>controller busy</source>
        <translation>控制器忙</translation>
    </message>
    <message>
        <source>gateway without an answer from the controller</source>
        <translation>网关未收到控制器应答</translation>
    </message>
    <message>
        <source>controller failed at a request</source>
        <translation>控制器执行请求失败</translation>
    </message>
    <message>
        <source>controller silent</source>
        <translation>控制器无应答</translation>
    </message>
    <message>
        <source>reply that does not belong to the question</source>
        <translation>应答与请求不符</translation>
    </message>
    <message>
        <source>connection to the controller lost</source>
        <translation>与控制器的连接中断</translation>
    </message>
    <message>
        <source>controller not reachable</source>
        <translation>无法连接控制器</translation>
    </message>
    <message>
        <source>machine could not be stopped</source>
        <translation>机床无法停止</translation>
    </message>
    <message>
        <source>reply in pieces</source>
        <translation>应答分段到达</translation>
    </message>
    <message>
        <source>sensor stuck</source>
        <translation>传感器卡死</translation>
    </message>
    <message>
        <source>sensor dead</source>
        <translation>传感器失效</translation>
    </message>
    <message>
        <source>sensor with spikes</source>
        <translation>传感器出现尖峰</translation>
    </message>
    <message>
        <source>sensor jumped</source>
        <translation>传感器读数跳变</translation>
    </message>
    <message>
        <source>sensors swapped</source>
        <translation>传感器位置互换</translation>
    </message>
    <message>
        <source>camera frozen</source>
        <translation>相机画面冻结</translation>
    </message>
    <message>
        <source>camera silent</source>
        <translation>相机不发送图像</translation>
    </message>
    <message>
        <source>camera not reachable</source>
        <translation>无法连接相机</translation>
    </message>
    <message>
        <source>measurement refused</source>
        <translation>测量被拒绝</translation>
    </message>
    <message>
        <source>target partly occluded</source>
        <translation>靶标部分被遮挡</translation>
    </message>
    <message>
        <source>disk full</source>
        <translation>磁盘已满</translation>
    </message>
    <message>
        <source>%1, once</source>
        <translation>%1，1 次</translation>
    </message>
    <message>
        <source>%1, %2 times</source>
        <translation>%1，%2 次</translation>
    </message>
    <message>
        <source>%1, asked again</source>
        <translation>%1，已重新询问</translation>
    </message>
    <message>
        <source>reference mark not seen</source>
        <translation>参考标记未识别</translation>
    </message>
    <message>
        <source>measuring period stretched</source>
        <translation>测量周期被延长</translation>
    </message>
    <message>
        <source>too few measurements expected</source>
        <translation>预计测量次数过少</translation>
    </message>
    <message>
        <source>leap of the error, refused</source>
        <translation>误差跳变，已拒绝</translation>
    </message>
    <message>
        <source>slip of the target, confirmed</source>
        <translation>靶标滑移，已确认</translation>
    </message>
    <message>
        <source>camera later than known</source>
        <translation>相机延迟比已知的更长</translation>
    </message>
    <message>
        <source>another camera than before</source>
        <translation>与此前不同的相机</translation>
    </message>
    <message>
        <source>several cameras</source>
        <translation>有多台相机</translation>
    </message>
    <message>
        <source>camera refuses a setting</source>
        <translation>相机拒绝设置</translation>
    </message>
    <message>
        <source>pixel format not read</source>
        <translation>像素格式无法读取</translation>
    </message>
</context>
<context>
    <name>steps</name>
    <message>
        <source>machine</source>
        <translation>机床</translation>
    </message>
    <message>
        <source>calibrate</source>
        <translation>标定</translation>
    </message>
    <message>
        <source>calibration</source>
        <translation>标定</translation>
    </message>
    <message>
        <source>warm-up</source>
        <translation>暖机</translation>
    </message>
    <message>
        <source>sensors</source>
        <translation>传感器</translation>
    </message>
    <message>
        <source>fit</source>
        <translation>拟合</translation>
    </message>
    <message>
        <source>model</source>
        <translation>模型</translation>
    </message>
    <message>
        <source>physics</source>
        <translation>物理分析</translation>
    </message>
    <message>
        <source>upload</source>
        <translation>上传</translation>
    </message>
    <message>
        <source>verify</source>
        <translation>验证</translation>
    </message>
    <message>
        <source>verification</source>
        <translation>验证</translation>
    </message>
    <message>
        <source>report</source>
        <translation>报告</translation>
    </message>
    <message>
        <source>axis errors</source>
        <translation>轴误差</translation>
    </message>
    <message>
        <source>axis table</source>
        <translation>轴补偿表</translation>
    </message>
    <message>
        <source>correction</source>
        <translation>修正</translation>
    </message>
    <message>
        <source>job</source>
        <translation>作业</translation>
    </message>
    <message>
        <source>, </source>
        <comment>between the names of steps</comment>
        <translation>、</translation>
    </message>
    <message>
        <source>description</source>
        <translation>描述</translation>
    </message>
    <message>
        <source>recordings</source>
        <translation>记录</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::Application</name>
    <message>
        <source>Switch the compensation ON?</source>
        <translation>接通补偿？</translation>
    </message>
    <message>
        <source>Switch the compensation OFF?</source>
        <translation>断开补偿？</translation>
    </message>
    <message>
        <source>The axes of %1 move by what the active table says.</source>
        <translation>%1 的各轴将按有效表移动。</translation>
    </message>
    <message>
        <source>The axes of %1 move back by what is applied now.</source>
        <translation>%1 的各轴将退回当前施加的补偿量。</translation>
    </message>
    <message>
        <source>Switch ON</source>
        <translation>接通</translation>
    </message>
    <message>
        <source>Switch OFF</source>
        <translation>断开</translation>
    </message>
    <message>
        <source>Switching the compensation</source>
        <translation>正在切换补偿</translation>
    </message>
    <message>
        <source>Compensation ON</source>
        <translation>补偿接通</translation>
    </message>
    <message>
        <source>Compensation OFF</source>
        <translation>补偿断开</translation>
    </message>
    <message>
        <source>Not started</source>
        <translation>未开始</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>就绪</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>完成</translation>
    </message>
    <message>
        <source>Out of date: %1</source>
        <comment>which step changed</comment>
        <translation>已过期：%1</translation>
    </message>
    <message>
        <source>No job</source>
        <translation>没有作业</translation>
    </message>
    <message>
        <source>New job</source>
        <translation>新作业</translation>
    </message>
    <message>
        <source>Controller connected</source>
        <translation>控制器已连接</translation>
    </message>
    <message>
        <source>Controller off</source>
        <translation>控制器未连接</translation>
    </message>
    <message>
        <source>Nothing running</source>
        <translation>无任务运行</translation>
    </message>
    <message>
        <source>Camera off</source>
        <translation>相机未连接</translation>
    </message>
    <message>
        <source>1 camera</source>
        <translation>1 台相机</translation>
    </message>
    <message>
        <source>%1 cameras</source>
        <translation>%1 台相机</translation>
    </message>
    <message>
        <source>Probes</source>
        <translation>测头</translation>
    </message>
    <message>
        <source>Close Zerodrift?</source>
        <translation>关闭 Zerodrift？</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Job</source>
        <translation>作业</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>窗口</translation>
    </message>
    <message>
        <source>Open job</source>
        <translation>打开作业</translation>
    </message>
    <message>
        <source>Open the sample job</source>
        <translation>打开示例作业</translation>
    </message>
    <message>
        <source>Connect to the virtual machine</source>
        <translation>连接虚拟机床</translation>
    </message>
    <message>
        <source>Undo the last choice</source>
        <translation>撤销上一次选择</translation>
    </message>
    <message>
        <source>Everybody may look. Writing to a machine needs the engineer.</source>
        <translation>任何人都可以查看。写入机床需要工程师权限。</translation>
    </message>
    <message>
        <source>Whoever comes next may look and not write. To change the PIN choose &quot;Change&quot;.</source>
        <translation>之后的使用者只能查看，不能写入。要更改 PIN，请选择“更改”。</translation>
    </message>
    <message>
        <source>Lock this computer?</source>
        <translation>锁定本机？</translation>
    </message>
    <message>
        <source>Lock</source>
        <translation>锁定</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>更改</translation>
    </message>
    <message>
        <source>Locked</source>
        <translation>已锁定</translation>
    </message>
    <message>
        <source>No PIN</source>
        <translation>无 PIN</translation>
    </message>
    <message>
        <source>Engineer</source>
        <translation>工程师</translation>
    </message>
    <message>
        <source>Compensation unknown</source>
        <translation>补偿状态未知</translation>
    </message>
    <message>
        <source>Controller lost</source>
        <translation>控制器失去连接</translation>
    </message>
    <message>
        <source>No picture</source>
        <translation>无图像</translation>
    </message>
    <message>
        <source>%1 of %2 cameras</source>
        <translation>%2 台相机中的 %1 台</translation>
    </message>
    <message>
        <source>Disconnected from the machine %1: this job is of the machine %2.</source>
        <translation>已断开机床 %1：此作业属于机床 %2。</translation>
    </message>
    <message>
        <source>To go on with the connected machine open its own job, or begin a new one.</source>
        <translation>要继续使用刚才连接的机床，请打开它自己的作业或新建作业。</translation>
    </message>
    <message>
        <source>The warm-up run of this job was interrupted after %1.</source>
        <translation>此作业的暖机运行在 %1 后中断。</translation>
    </message>
    <message>
        <source>On the Warm-up page it goes on, or is finished with what was recorded.</source>
        <translation>可在“暖机”页继续运行，或以已记录的数据结束。</translation>
    </message>
    <message>
        <source>%1 off</source>
        <translation>%1未打开</translation>
    </message>
    <message>
        <source>Controller not asked just now</source>
        <translation>目前未查询控制器</translation>
    </message>
    <message>
        <source>It is broken off; what the job holds already is kept.</source>
        <translation>该操作将中断；作业中已有的内容会保留。</translation>
    </message>
    <message>
        <source>%1 is running.</source>
        <translation>正在进行：%1。</translation>
    </message>
    <message>
        <source>The spindle, the path and the coolant stop. What was recorded is kept and the run can be resumed.</source>
        <translation>主轴、轨迹和冷却液停止。已记录的数据会保留，运行可以继续。</translation>
    </message>
    <message>
        <source>The offset runs to 0 and the compensation is switched as it was before.</source>
        <translation>偏置归零，补偿恢复为原来的开关状态。</translation>
    </message>
    <message>
        <source>%1 in use</source>
        <translation>%1使用中</translation>
    </message>
    <message>
        <source>Running</source>
        <translation>正在进行</translation>
    </message>
    <message>
        <source>The job is damaged</source>
        <translation>作业已损坏</translation>
    </message>
    <message>
        <source>Import a recording</source>
        <translation>导入记录</translation>
    </message>
    <message>
        <source>Not needed</source>
        <translation>不需要</translation>
    </message>
    <message>
        <source>This job is made from files: no machine is connected, and nothing is written to one.</source>
        <translation>本作业由文件生成：不连接机床，也不向机床写入任何内容。</translation>
    </message>
    <message>
        <source>Use a machine with this job</source>
        <translation>为本作业使用机床</translation>
    </message>
    <message>
        <source>The errors of an imported recording are measured already: there is no camera to calibrate.</source>
        <translation>导入的记录中误差已经测好：没有相机需要标定。</translation>
    </message>
    <message>
        <source>There is no controller to write to. Export gives the table as a file that a controller loads.</source>
        <translation>没有可写入的控制器。“导出”把补偿表保存为控制器可读入的文件。</translation>
    </message>
    <message>
        <source>What is left can only be measured on the machine, with the table active. The Fit page says what to expect on data that the model has not seen.</source>
        <translation>剩余误差只能在补偿表生效的机床上测量。“拟合”页给出在模型未见数据上的预期。</translation>
    </message>
    <message>
        <source>Compensating from this computer needs a connected machine.</source>
        <translation>由本计算机补偿需要已连接的机床。</translation>
    </message>
    <message>
        <source>The recording holds no error, so there is nothing to fit. Its heat can be explained, in Physics.</source>
        <translation>记录中没有误差，因此没有可拟合的内容。其热行为可在“物理分析”页解释。</translation>
    </message>
    <message>
        <source>The recording holds no error, so there is nothing to compensate.</source>
        <translation>记录中没有误差，因此没有可补偿的内容。</translation>
    </message>
    <message>
        <source>%1 waits</source>
        <translation>%1：等待中</translation>
    </message>
    <message>
        <source>The verification run of this job was interrupted after %1.</source>
        <translation>此作业的验证运行在 %1 后中断。</translation>
    </message>
    <message>
        <source>On the Verify page it goes on, or is finished with what was recorded.</source>
        <translation>可在“验证”页继续，或以已记录的数据结束。</translation>
    </message>
    <message>
        <source>The spindle, the path and the coolant stop; the compensation stays as it is switched. What was recorded is kept and the run can be resumed.</source>
        <translation>主轴、轨迹运动和冷却液停止；补偿开关保持现状。已记录的数据会保留，运行可继续。</translation>
    </message>
    <message>
        <source>Manual control</source>
        <translation>手动控制</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::AxisErrorsPresenter</name>
    <message>
        <source>Laser report</source>
        <translation>激光测量报告</translation>
    </message>
    <message>
        <source>Laser reports (*.csv *.rtl *.REN *.ren *.pos);;All files (*)</source>
        <translation>激光测量报告 (*.csv *.rtl *.REN *.ren *.pos);;所有文件 (*)</translation>
    </message>
    <message>
        <source>Columns as for the last file of this make</source>
        <translation>各列沿用该类文件上次的设置</translation>
    </message>
    <message>
        <source>Laser report %1</source>
        <translation>激光测量报告 %1</translation>
    </message>
    <message numerus="yes">
        <source>%1: %n target(s)</source>
        <translation>
            <numerusform>%1：%n 个目标位置</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n run(s)</source>
        <translation>
            <numerusform>%n 次测量</numerusform>
        </translation>
    </message>
    <message>
        <source>accuracy, both directions</source>
        <translation>双向定位精度</translation>
    </message>
    <message>
        <source>accuracy upwards</source>
        <translation>正向定位精度</translation>
    </message>
    <message>
        <source>accuracy downwards</source>
        <translation>负向定位精度</translation>
    </message>
    <message>
        <source>systematic deviation</source>
        <translation>双向定位系统偏差</translation>
    </message>
    <message>
        <source>repeatability, both directions</source>
        <translation>双向重复定位精度</translation>
    </message>
    <message>
        <source>repeatability upwards</source>
        <translation>正向重复定位精度</translation>
    </message>
    <message>
        <source>repeatability downwards</source>
        <translation>负向重复定位精度</translation>
    </message>
    <message>
        <source>reversal, largest</source>
        <translation>反向差值，最大</translation>
    </message>
    <message>
        <source>reversal, mean</source>
        <translation>反向差值，平均</translation>
    </message>
    <message>
        <source>range of the mean deviation</source>
        <translation>平均双向定位偏差的范围</translation>
    </message>
    <message>
        <source>positional uncertainty</source>
        <translation>定位不确定度</translation>
    </message>
    <message>
        <source>positional deviation</source>
        <translation>位置偏差</translation>
    </message>
    <message>
        <source>scatter, largest</source>
        <translation>位置离散度，最大</translation>
    </message>
    <message>
        <source>scatter, mean</source>
        <translation>位置离散度，平均</translation>
    </message>
    <message>
        <source>this table cannot be written in it</source>
        <translation>该补偿表无法写成此格式</translation>
    </message>
    <message>
        <source>In the table: %1</source>
        <translation>已在补偿表中：%1</translation>
    </message>
    <message>
        <source>%1 loaded</source>
        <translation>%1 已载入</translation>
    </message>
    <message>
        <source>When needed</source>
        <translation>需要时使用</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::CalibratePresenter</name>
    <message>
        <source>Calibrating</source>
        <translation>正在标定</translation>
    </message>
    <message>
        <source>Connect a machine and start the commissioning first.</source>
        <translation>请先连接机床并开始调试。</translation>
    </message>
    <message>
        <source>This machine is measured with displacement probes; no camera has to be calibrated.</source>
        <translation>该机床用位移测头测量，无需标定相机。</translation>
    </message>
    <message>
        <source>Waiting for your word: camera %1</source>
        <translation>等待您的确认：相机 %1</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::CompensatorPresenter</name>
    <message>
        <source>compensating</source>
        <translation>正在补偿</translation>
    </message>
    <message>
        <source>at the edge</source>
        <translation>到达边界</translation>
    </message>
    <message>
        <source>running to 0</source>
        <translation>正在归零</translation>
    </message>
    <message>
        <source>ending</source>
        <translation>正在结束</translation>
    </message>
    <message>
        <source>The axes of %1 move by what the model predicts, at most %2 µm, until you press Stop.</source>
        <translation>%1 的各轴将按模型预测值移动，最大 %2 µm，直到按下“停止”。</translation>
    </message>
    <message>
        <source>The compensation is switched ON for it and OFF after it.</source>
        <translation>为此将接通补偿，结束后断开。</translation>
    </message>
    <message>
        <source>First the axes go to the measuring position and a test offset of 10 µm is written in each direction, while the camera watches that it goes the right way. Is the work area clear?</source>
        <translation>首先各轴移动到测量位置，并在每个方向写入 10 µm 的测试偏置，由相机观测方向是否正确。工作区是否已清空？</translation>
    </message>
    <message>
        <source>Compensate from this computer?</source>
        <translation>由本计算机进行补偿？</translation>
    </message>
    <message>
        <source>Start compensating</source>
        <translation>开始补偿</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>正在启动</translation>
    </message>
    <message>
        <source>checking signs</source>
        <translation>正在检查符号</translation>
    </message>
    <message>
        <source>Host compensator</source>
        <translation>上位机补偿器</translation>
    </message>
    <message>
        <source>no answer</source>
        <translation>无应答</translation>
    </message>
    <message>
        <source>The controller does not answer; its watchdog takes the offset out meanwhile.</source>
        <translation>控制器无应答；在此期间其看门狗会撤销偏置。</translation>
    </message>
    <message>
        <source>switch is OFF</source>
        <translation>开关已断开</translation>
    </message>
    <message>
        <source>Ended after %1: %2 turns, %3 without the controller; the offset is back at 0.</source>
        <translation>%1 后结束：共 %2 个周期，其中 %3 个没有控制器应答；偏置已归零。</translation>
    </message>
    <message>
        <source>When needed</source>
        <translation>需要时使用</translation>
    </message>
    <message>
        <source>Fit a model first: it says from the temperatures what to compensate.</source>
        <translation>请先拟合模型：由它根据温度得出补偿量。</translation>
    </message>
    <message>
        <source>Connect the machine first.</source>
        <translation>请先连接机床。</translation>
    </message>
    <message>
        <source>Compensating</source>
        <translation>正在补偿</translation>
    </message>
    <message>
        <source>The controller holds a table of its own: roll it back in Upload first.</source>
        <translation>控制器中有自身的补偿表：请先在“上传”页将其回退。</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::DemoMachine</name>
    <message>
        <source>it ended at once</source>
        <translation>程序立即结束</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::FileOpener</name>
    <message>
        <source>%1 was not opened, because %2 is running.</source>
        <translation>未打开 %1，因为“%2”正在进行。</translation>
    </message>
    <message>
        <source>Wait until it has ended, or end it, and open the file then.</source>
        <translation>请等待其结束，或将其结束，然后再打开该文件。</translation>
    </message>
    <message>
        <source>%1 is none of the files that can be opened here.</source>
        <translation>%1 不是此处可以打开的文件。</translation>
    </message>
    <message>
        <source>sample</source>
        <translation>示例</translation>
    </message>
    <message>
        <source>Jobs (.zdj), connection profiles, plans and machine descriptions (.json), laser reports (.csv, .rtl, .REN, .pos) and recordings (.csv, .txt, .lvm, .xlsx) can.</source>
        <translation>可以打开作业（.zdj）、连接配置、计划和机床描述（.json）、激光报告（.csv、.rtl、.REN、.pos）以及记录（.csv、.txt、.lvm、.xlsx）。</translation>
    </message>
    <message>
        <source>Import a recording</source>
        <translation>导入记录</translation>
    </message>
    <message>
        <source>Recordings (*.csv *.txt *.tsv *.dat *.lvm *.xlsx);;All files (*)</source>
        <translation>记录 (*.csv *.txt *.tsv *.dat *.lvm *.xlsx);;所有文件 (*)</translation>
    </message>
    <message>
        <source>Use in a new job</source>
        <translation>用于新作业</translation>
    </message>
    <message>
        <source>Replace the run</source>
        <translation>替换该运行</translation>
    </message>
    <message>
        <source>Use this recording</source>
        <translation>使用此记录</translation>
    </message>
    <message>
        <source>Add the recording</source>
        <translation>添加记录</translation>
    </message>
    <message>
        <source>first run, in its place</source>
        <translation>替换首次运行</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::FitPresenter</name>
    <message>
        <source>Fitting the model</source>
        <translation>正在拟合模型</translation>
    </message>
    <message>
        <source>%1 to %2 rpm</source>
        <translation>%1 至 %2 r/min</translation>
    </message>
    <message>
        <source>%1 to %2 °C</source>
        <translation>%1 至 %2 °C</translation>
    </message>
    <message>
        <source>Choose the sensors first: the model is fitted to them.</source>
        <translation>请先选择传感器：模型以它们拟合。</translation>
    </message>
    <message>
        <source>Recording of a newer run</source>
        <translation>较新运行的记录</translation>
    </message>
    <message>
        <source>Recordings (*.csv)</source>
        <translation>记录 (*.csv)</translation>
    </message>
    <message>
        <source>Updating the model</source>
        <translation>正在更新模型</translation>
    </message>
    <message>
        <source>On %1, another day that it has not seen, it leaves (rms): %2.</source>
        <translation>在未参与拟合的另一天记录“%1”上，残差均方根为：%2。</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::MachineForm</name>
    <message>
        <source>Open a machine description</source>
        <translation>打开机床描述</translation>
    </message>
    <message>
        <source>Machine descriptions (*.json)</source>
        <translation>机床描述 (*.json)</translation>
    </message>
    <message>
        <source>Export the description</source>
        <translation>导出描述</translation>
    </message>
    <message>
        <source>Rod: spindle, screw, ram</source>
        <translation>杆件：主轴、丝杠、滑枕</translation>
    </message>
    <message>
        <source>Lump: housing, column, motor body</source>
        <translation>集总体：箱体、立柱、电机机体</translation>
    </message>
    <message>
        <source>Heat source of the selected part</source>
        <translation>所选部件的热源</translation>
    </message>
    <message>
        <source>Coupling of two parts</source>
        <translation>两个部件的热连接</translation>
    </message>
    <message>
        <source>Temperature sensor</source>
        <translation>温度传感器</translation>
    </message>
    <message>
        <source>Displacement</source>
        <translation>位移</translation>
    </message>
    <message>
        <source>Expected: %1</source>
        <translation>应为：%1</translation>
    </message>
    <message>
        <source>%1, %2: something must be entered.</source>
        <translation>%1，%2：必须填写。</translation>
    </message>
    <message>
        <source>%1, %2: this value cannot be.</source>
        <translation>%1，%2：该值不可能。</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::MachinePresenter</name>
    <message>
        <source>The virtual machine could not be started: %1.</source>
        <translation>无法启动虚拟机床：%1。</translation>
    </message>
    <message>
        <source>Check that zerodrift-machine stands beside this program.</source>
        <translation>请确认 zerodrift-machine 与本程序位于同一文件夹。</translation>
    </message>
    <message>
        <source>New job</source>
        <translation>新作业</translation>
    </message>
    <message>
        <source>Zerodrift jobs (*.zdj)</source>
        <translation>Zerodrift 作业 (*.zdj)</translation>
    </message>
    <message>
        <source>Open job</source>
        <translation>打开作业</translation>
    </message>
    <message>
        <source>Connection profile</source>
        <translation>连接配置文件</translation>
    </message>
    <message>
        <source>Profiles (*.json)</source>
        <translation>配置文件 (*.json)</translation>
    </message>
    <message>
        <source>Checking the machine</source>
        <translation>正在检查机床</translation>
    </message>
    <message>
        <source>Modbus RTU %1, unit %2</source>
        <translation>Modbus RTU %1, 单元 %2</translation>
    </message>
    <message>
        <source>Modbus TCP %1:%2, unit %3</source>
        <translation>Modbus TCP %1:%2, 单元 %3</translation>
    </message>
    <message>
        <source>Something runs on the machine: what stands here was seen at %1.</source>
        <translation>机床上正在运行任务：此处显示的是 %1 的状态。</translation>
    </message>
    <message>
        <source>The page of the run shows it live.</source>
        <translation>实时状态请看运行页面。</translation>
    </message>
    <message>
        <source>No signal</source>
        <translation>无信号</translation>
    </message>
    <message>
        <source>Stuck</source>
        <translation>卡死</translation>
    </message>
    <message>
        <source>OK</source>
        <translation>正常</translation>
    </message>
    <message>
        <source>%1 axis</source>
        <translation>%1 轴</translation>
    </message>
    <message>
        <source>Spindle</source>
        <translation>主轴</translation>
    </message>
    <message>
        <source>%1 rpm</source>
        <translation>%1 r/min</translation>
    </message>
    <message>
        <source>Compensation</source>
        <translation>补偿</translation>
    </message>
    <message>
        <source>ON</source>
        <translation>接通</translation>
    </message>
    <message>
        <source>OFF</source>
        <translation>断开</translation>
    </message>
    <message>
        <source>Leave this job?</source>
        <translation>离开此作业？</translation>
    </message>
    <message>
        <source>End it and leave</source>
        <translation>结束并离开</translation>
    </message>
    <message>
        <source>Disconnect from the machine?</source>
        <translation>断开与机床的连接？</translation>
    </message>
    <message>
        <source>End it and disconnect</source>
        <translation>结束并断开</translation>
    </message>
    <message>
        <source>Manual control</source>
        <translation>手动控制</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::MapEditor</name>
    <message>
        <source>refused</source>
        <translation>被拒绝</translation>
    </message>
    <message>
        <source>, changed: save it to use it</source>
        <translation>，已修改：保存后生效</translation>
    </message>
    <message>
        <source>no %1 without %2</source>
        <translation>缺少 %2，无法使用%1</translation>
    </message>
    <message numerus="yes">
        <source>no %1 without %2 and %n more</source>
        <translation>
            <numerusform>缺少 %2 及另外 %n 个，无法使用%1</numerusform>
        </translation>
    </message>
    <message>
        <source>Registers</source>
        <translation>寄存器</translation>
    </message>
    <message>
        <source>Register lists and maps (*.csv *.txt *.json);;All files (*)</source>
        <translation>寄存器列表和映射 (*.csv *.txt *.json);;所有文件 (*)</translation>
    </message>
    <message>
        <source>Save register map</source>
        <translation>保存寄存器映射</translation>
    </message>
    <message>
        <source>Maps (*.json)</source>
        <translation>映射 (*.json)</translation>
    </message>
    <message>
        <source>no use known</source>
        <translation>用途未知</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::OperatorDialog</name>
    <message>
        <source>At the control</source>
        <translation>在控制器旁</translation>
    </message>
    <message>
        <source>Check value</source>
        <translation>校验值</translation>
    </message>
    <message>
        <source>It is off</source>
        <translation>已断开</translation>
    </message>
    <message>
        <source>It is on</source>
        <translation>已接通</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>完成</translation>
    </message>
    <message>
        <source>Cannot be done</source>
        <translation>无法完成</translation>
    </message>
    <message>
        <source>Why not?</source>
        <translation>原因是什么？</translation>
    </message>
    <message>
        <source>no reason given</source>
        <translation>未说明原因</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::PhysicsPresenter</name>
    <message>
        <source>Looking for what the simulation lacks</source>
        <translation>正在查找仿真缺少的内容</translation>
    </message>
    <message>
        <source>No sensor region could be found: the machine description has no rod whose deformation was simulated.</source>
        <translation>未能找到传感器区域：机床描述中没有可仿真变形的杆件。</translation>
    </message>
    <message>
        <source>A sensor between %1 and %2 mm from the fixed end of the %3 follows the deformation best</source>
        <translation>距%3固定端 %1 至 %2 mm 处的传感器与变形的相关性最好</translation>
    </message>
    <message>
        <source> (r = %1</source>
        <translation>（r = %1</translation>
    </message>
    <message>
        <source>, %1 µm left by a straight line</source>
        <translation>，用直线拟合后剩余 %1 µm</translation>
    </message>
    <message>
        <source>Blind trial</source>
        <translation>盲测</translation>
    </message>
    <message>
        <source>Blind trial: sealed %1</source>
        <translation>盲测：已封存 %1</translation>
    </message>
    <message>
        <source>Searching what is hidden</source>
        <translation>正在查找隐藏的效应</translation>
    </message>
    <message>
        <source>, %1 %</source>
        <translation>，%1 %</translation>
    </message>
    <message>
        <source>Blind trial: hidden %1, answered %2, seal %3</source>
        <translation>盲测：隐藏 %1，答案 %2，封条%3</translation>
    </message>
    <message>
        <source>whole</source>
        <translation>完好</translation>
    </message>
    <message>
        <source>broken</source>
        <translation>已破坏</translation>
    </message>
    <message>
        <source>Record a warm-up run first: it is what the simulation is compared with.</source>
        <translation>请先记录一次暖机运行：仿真将与之比较。</translation>
    </message>
    <message>
        <source>%1.</source>
        <comment>a whole sentence</comment>
        <translation>%1。</translation>
    </message>
    <message>
        <source>What the simulation lacks was not searched.</source>
        <translation>未能查找仿真所缺的内容。</translation>
    </message>
    <message>
        <source>Open a machine description</source>
        <translation>打开机床描述</translation>
    </message>
    <message>
        <source>Machine descriptions (*.json)</source>
        <translation>机床描述 (*.json)</translation>
    </message>
    <message>
        <source>A lump for each sensor</source>
        <translation>每个传感器一个集总体</translation>
    </message>
    <message>
        <source>a lump for each sensor</source>
        <translation>每个传感器一个集总体</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::PinDialog</name>
    <message>
        <source>The engineer&apos;s PIN</source>
        <translation>工程师 PIN</translation>
    </message>
    <message>
        <source>PIN</source>
        <translation>PIN</translation>
    </message>
    <message>
        <source>Unlock</source>
        <translation>解锁</translation>
    </message>
    <message>
        <source>Unlocked: the engineer may write to the machine</source>
        <translation>已解锁：工程师可以写入机床</translation>
    </message>
    <message>
        <source>PIN until now</source>
        <translation>当前 PIN</translation>
    </message>
    <message>
        <source>New PIN (empty: none any more)</source>
        <translation>新 PIN（留空：不再使用）</translation>
    </message>
    <message>
        <source>New PIN</source>
        <translation>新 PIN</translation>
    </message>
    <message>
        <source>New PIN again</source>
        <translation>再次输入新 PIN</translation>
    </message>
    <message>
        <source>PIN of this computer</source>
        <translation>本机 PIN</translation>
    </message>
    <message>
        <source>With a PIN everybody may look, and only who knows it may write to a machine. After a while without a touch it is asked for again.</source>
        <translation>设置 PIN 后，任何人都可以查看，只有知道 PIN 的人才能写入机床。一段时间无操作后会再次要求输入。</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>设置</translation>
    </message>
    <message>
        <source>A PIN is set</source>
        <translation>已设置 PIN</translation>
    </message>
    <message>
        <source>No PIN any more</source>
        <translation>已取消 PIN</translation>
    </message>
    <message>
        <source>Locked: nobody has touched the window</source>
        <translation>已锁定：窗口长时间无操作</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::Presenter</name>
    <message>
        <source>No machine is connected: connect it on the Machine page.</source>
        <translation>未连接机床：请在“机床”页连接。</translation>
    </message>
    <message>
        <source>The controller does not answer.</source>
        <translation>控制器没有应答。</translation>
    </message>
    <message>
        <source>The machine holds none</source>
        <translation>机床中没有</translation>
    </message>
    <message>
        <source>The machine holds another</source>
        <translation>机床中为另一张表</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::RecordingImport</name>
    <message>
        <source>Reading the file</source>
        <translation>正在读取文件</translation>
    </message>
    <message>
        <source>It must have been recorded with the compensation off.</source>
        <translation>该记录必须是在补偿断开时记录的。</translation>
    </message>
    <message>
        <source>Header map</source>
        <translation>列映射</translation>
    </message>
    <message>
        <source>Header maps (*.json)</source>
        <translation>列映射 (*.json)</translation>
    </message>
    <message>
        <source>Save map</source>
        <translation>保存映射</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::ReportPresenter</name>
    <message>
        <source>Save report</source>
        <translation>保存报告</translation>
    </message>
    <message>
        <source>Report saved: %1</source>
        <translation>报告已保存：%1</translation>
    </message>
    <message>
        <source>Preview of the report</source>
        <translation>报告预览</translation>
    </message>
    <message>
        <source>Saving the report</source>
        <translation>正在保存报告</translation>
    </message>
    <message>
        <source>Technical bundle: %1</source>
        <translation>技术数据包：%1</translation>
    </message>
    <message>
        <source>always part of the report</source>
        <translation>始终属于报告</translation>
    </message>
    <message>
        <source>The report is written from what was measured. Record a warm-up run first.</source>
        <translation>报告由测量结果生成。请先记录一次暖机运行。</translation>
    </message>
    <message>
        <source>Report to print and sign (*.pdf)</source>
        <translation>用于打印和签字的报告 (*.pdf)</translation>
    </message>
    <message>
        <source>Web page with links to the data (*.html)</source>
        <translation>带数据链接的网页 (*.html)</translation>
    </message>
    <message>
        <source>Figures for a spreadsheet (*.csv)</source>
        <translation>用于电子表格的数据 (*.csv)</translation>
    </message>
    <message>
        <source>No program opens %1.</source>
        <translation>没有程序可打开 %1。</translation>
    </message>
    <message>
        <source>Open it with a program of your own.</source>
        <translation>请自行选择程序打开。</translation>
    </message>
    <message>
        <source>Printing the report</source>
        <translation>正在打印报告</translation>
    </message>
    <message>
        <source>Report printed</source>
        <translation>报告已打印</translation>
    </message>
    <message>
        <source>Head of the report</source>
        <translation>报告抬头</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::RigEditor</name>
    <message numerus="yes">
        <source>%n sensor(s) added; see Signals.</source>
        <translation>
            <numerusform>已添加 %n 个传感器；见“信号”。</numerusform>
        </translation>
    </message>
    <message>
        <source>Expected: %1</source>
        <translation>应为：%1</translation>
    </message>
    <message>
        <source>%1, %2: something must be entered.</source>
        <translation>%1，%2：必须填写。</translation>
    </message>
    <message>
        <source>%1, %2: this value cannot be.</source>
        <translation>%1，%2：此数值无效。</translation>
    </message>
    <message>
        <source>Signals</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>Save profile</source>
        <translation>保存配置文件</translation>
    </message>
    <message>
        <source>Profiles (*.json)</source>
        <translation>配置文件 (*.json)</translation>
    </message>
    <message>
        <source>Open profile</source>
        <translation>打开配置文件</translation>
    </message>
    <message>
        <source>Enter the camera&apos;s address first.</source>
        <translation>请先输入相机地址。</translation>
    </message>
    <message>
        <source>Waiting for a picture</source>
        <translation>等待图像</translation>
    </message>
    <message>
        <source>%1 × %2 px, %3 pictures a second</source>
        <translation>%1 × %2 像素，每秒 %3 幅</translation>
    </message>
    <message>
        <source>Draw the target&apos;s region into the picture.</source>
        <translation>请在图像中绘制目标区域。</translation>
    </message>
    <message>
        <source>Ended; nothing was found so far.</source>
        <translation>已结束；未找到任何设备。</translation>
    </message>
    <message>
        <source>Nothing was found.</source>
        <translation>未找到任何设备。</translation>
    </message>
    <message>
        <source>Choose what to enter.</source>
        <translation>请选择要填入的项。</translation>
    </message>
    <message>
        <source>Looking for serial ports</source>
        <translation>正在查找串口</translation>
    </message>
    <message>
        <source>Asking the units 1 to 247</source>
        <translation>正在询问单元 1 至 247</translation>
    </message>
    <message>
        <source>Unit %1</source>
        <translation>单元 %1</translation>
    </message>
    <message>
        <source>Looking into the local network</source>
        <translation>正在搜索本地网络</translation>
    </message>
    <message>
        <source>port %1</source>
        <translation>端口 %1</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>正在查找相机</translation>
    </message>
    <message>
        <source>serial number %1, %2</source>
        <translation>序列号 %1，%2</translation>
    </message>
    <message>
        <source>Testing %1</source>
        <translation>正在测试 %1</translation>
    </message>
    <message>
        <source>Answers in %1.</source>
        <translation>应答时间 %1。</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::RunFeed</name>
    <message>
        <source>Room</source>
        <translation>室温</translation>
    </message>
    <message>
        <source>Left over</source>
        <translation>残余</translation>
    </message>
    <message>
        <source>Error at the nose</source>
        <translation>主轴端部的误差</translation>
    </message>
    <message>
        <source>%1 left</source>
        <translation>%1 残余</translation>
    </message>
    <message>
        <source>Without the compensation</source>
        <translation>无补偿</translation>
    </message>
    <message>
        <source>%1 without</source>
        <translation>%1 无补偿</translation>
    </message>
    <message>
        <source>Applied by the controller</source>
        <translation>控制器施加</translation>
    </message>
    <message>
        <source>%1 applied</source>
        <translation>%1 已施加</translation>
    </message>
    <message>
        <source>Spindle speed</source>
        <translation>主轴转速</translation>
    </message>
    <message>
        <source>%1 of %2 measurements without all directions</source>
        <translation>%2 次测量中有 %1 次方向不全</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>暂停</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::RunPresenter</name>
    <message>
        <source>all axes go to the measuring position, again and again</source>
        <translation>所有轴反复移动到测量位置</translation>
    </message>
    <message>
        <source>the spindle turns at up to %1 rpm</source>
        <translation>主轴最高转速为 %1 r/min</translation>
    </message>
    <message>
        <source>the axes run their path in between</source>
        <translation>其间各轴沿路径运动</translation>
    </message>
    <message>
        <source>the coolant runs</source>
        <translation>冷却液开启</translation>
    </message>
    <message>
        <source>Start the run? The machine will move.</source>
        <translation>开始运行？机床将会运动。</translation>
    </message>
    <message>
        <source>For %1 of machine time: %2. Is the work area clear, the door closed and the tool fit for this speed?</source>
        <translation>机床时间 %1：%2。工作区是否已清空、防护门是否关闭、刀具是否适合该转速？</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>开始</translation>
    </message>
    <message>
        <source>Finish the run?</source>
        <translation>结束运行？</translation>
    </message>
    <message>
        <source>The run ends here and what was recorded is kept and used. The spindle, the path and the coolant stop.</source>
        <translation>运行在此结束，已记录的内容将保留并采用。主轴、路径运动和冷却液将停止。</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>结束</translation>
    </message>
    <message>
        <source>Abort the run?</source>
        <translation>中止运行？</translation>
    </message>
    <message>
        <source>The machine stops and this run is not used. Its samples stay in the job, but the step counts as not done. To keep the run, finish it instead.</source>
        <translation>机床停止，本次运行不予采用。采样仍保留在作业中，但该步骤视为未完成。若要保留本次运行，请选择“结束”。</translation>
    </message>
    <message>
        <source>Abort</source>
        <translation>中止</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>备注</translation>
    </message>
    <message>
        <source>What happened?</source>
        <translation>发生了什么？</translation>
    </message>
    <message>
        <source>%1 on the wall</source>
        <translation>实际剩余 %1</translation>
    </message>
    <message>
        <source>The run ended before this note was kept: %1</source>
        <translation>运行在保存此备注之前已结束：%1</translation>
    </message>
    <message>
        <source>Copy it from here if it matters.</source>
        <translation>如有需要，请从此处复制。</translation>
    </message>
    <message>
        <source>The run ends here and what was recorded is kept and used. The controller does not answer, so nothing is stopped from here: look whether the spindle stands.</source>
        <translation>运行到此结束，已记录的数据会保存并使用。控制器没有应答，因此无法从此处停止机床：请查看主轴是否已停。</translation>
    </message>
    <message>
        <source>Controller lost</source>
        <translation>控制器失去连接</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::SensorsPresenter</name>
    <message>
        <source>Clustering the sensors</source>
        <translation>正在对传感器聚类</translation>
    </message>
    <message>
        <source>Record a warm-up run first: the sensors are chosen from it.</source>
        <translation>请先记录一次暖机运行：传感器由此选出。</translation>
    </message>
    <message numerus="yes">
        <source>%n proposed: one speed does not tell which of them matter at another. A run at a second speed does.</source>
        <translation>
            <numerusform>建议 %n 个：单一转速无法判断其他转速下哪些传感器重要；第二个转速的运行可以判断。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n proposed: with %1 the error to expect would be only %2 µm less.</source>
        <translation>
            <numerusform>建议 %n 个：再加上 %1，预期误差仅减小 %2 µm。</numerusform>
        </translation>
    </message>
    <message>
        <source>Without %1 the condition number falls from %2 to the limit, for an error of only %3 µm more.</source>
        <translation>去掉 %1 后，条件数从 %2 降到限值以内，误差仅增大 %3 µm。</translation>
    </message>
    <message>
        <source>They are much alike: condition number %1, limit %2.</source>
        <translation>它们非常相似：条件数 %1，限值 %2。</translation>
    </message>
    <message numerus="yes">
        <source>Within the limit only %n would remain, fewer than there are clusters.</source>
        <translation>
            <numerusform>满足限值的只剩 %n 个，少于聚类数。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Within the limit only %n would remain.</source>
        <translation>
            <numerusform>满足限值的只剩 %n 个。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Within the limit only %n would remain, for an error of %1 µm more.</source>
        <translation>
            <numerusform>满足限值的只剩 %n 个，误差增大 %1 µm。</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::Tour</name>
    <message>
        <source>The folder %1 cannot be made.</source>
        <translation>无法创建文件夹 %1。</translation>
    </message>
    <message>
        <source>The tour is complete.</source>
        <translation>巡览完成。</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::UploadPresenter</name>
    <message>
        <source>temperature terms and position points</source>
        <translation>温度项和位置点</translation>
    </message>
    <message>
        <source>position points</source>
        <translation>位置点</translation>
    </message>
    <message>
        <source>temperature terms</source>
        <translation>温度项</translation>
    </message>
    <message>
        <source>Sign seen by the camera</source>
        <translation>相机观测符号</translation>
    </message>
    <message>
        <source>dry run %1</source>
        <translation>试运行 %1</translation>
    </message>
    <message>
        <source>Fit the model first: the table is made from it.</source>
        <translation>请先拟合模型：补偿表由模型生成。</translation>
    </message>
    <message>
        <source>checked %1</source>
        <translation>%1 检查</translation>
    </message>
    <message>
        <source>the model&apos;s memory of the past (its static part is written)</source>
        <translation>模型的历史记忆部分（只写入静态部分）</translation>
    </message>
    <message>
        <source>Reading the table in the machine</source>
        <translation>正在读取机床中的补偿表</translation>
    </message>
    <message>
        <source>The machine holds version %1, which is not the table of this job.</source>
        <translation>机床中为版本 %1，不是本作业的补偿表。</translation>
    </message>
    <message numerus="yes">
        <source>%n register(s)</source>
        <translation>
            <numerusform>%n 个寄存器</numerusform>
        </translation>
    </message>
    <message>
        <source>The dry run is good: the machine is ready, %1 fit, the largest change now would be %2 µm in %3.</source>
        <translation>试运行通过：机床就绪，%1容量足够，此刻的最大变化为 %2 µm（%3 轴）。</translation>
    </message>
    <message>
        <source>Nothing was written, not even the switch.</source>
        <translation>未写入任何内容，开关也未动作。</translation>
    </message>
    <message>
        <source>Dry run: %1, nothing written</source>
        <translation>试运行：%1，未写入任何内容</translation>
    </message>
    <message>
        <source>Write the table into %1?</source>
        <translation>将补偿表写入 %1？</translation>
    </message>
    <message>
        <source>%1 (serial %2)</source>
        <translation>%1（序列号 %2）</translation>
    </message>
    <message>
        <source>Write</source>
        <translation>写入</translation>
    </message>
    <message>
        <source>Writing the table</source>
        <translation>正在写入补偿表</translation>
    </message>
    <message>
        <source>Go back to version %1 in %2?</source>
        <translation>在 %2 中回滚到版本 %1？</translation>
    </message>
    <message>
        <source>Go back</source>
        <translation>回滚</translation>
    </message>
    <message>
        <source>Going back to version %1</source>
        <translation>正在回滚到版本 %1</translation>
    </message>
    <message>
        <source>Move the axes of %1 by 10 µm?</source>
        <translation>将 %1 的各轴移动 10 µm？</translation>
    </message>
    <message>
        <source>A test offset is written for X, Y and Z, one after the other, watched by the camera and taken back.</source>
        <translation>依次对 X、Y、Z 写入测试偏置，由相机观测后撤销。</translation>
    </message>
    <message>
        <source>Move</source>
        <translation>移动</translation>
    </message>
    <message>
        <source>Checking the sign</source>
        <translation>正在检查符号</translation>
    </message>
    <message>
        <source>It was written from elsewhere. Compare before you write; it is kept in the history then.</source>
        <translation>它由其他程序写入。写入前请先比较；写入时它会保留在历史中。</translation>
    </message>
    <message>
        <source>Nothing changes at the temperatures of this moment.</source>
        <translation>在此刻的温度下没有变化。</translation>
    </message>
    <message>
        <source>The largest change now is %1 µm in %2.</source>
        <translation>此刻最大变化为 %2 轴 %1 µm。</translation>
    </message>
    <message>
        <source>The table of version %1 is written again, as version %2, in place of version %3. %4 The switch is left as it is; nothing is taken out of the history.</source>
        <translation>版本 %1 的补偿表将作为版本 %2 重新写入，取代版本 %3。%4 开关保持原状；历史中不会删除任何内容。</translation>
    </message>
    <message>
        <source>The machine holds no table: what this job wrote is not in it any more.</source>
        <translation>机床中没有补偿表：此作业写入的内容已不在其中。</translation>
    </message>
    <message>
        <source>Write puts the last one back, with its corrections; the history has them all.</source>
        <translation>“写入”将恢复最后一个补偿表（含修正）；历史记录中有全部版本。</translation>
    </message>
    <message>
        <source>%1.</source>
        <comment>a whole sentence</comment>
        <translation>%1。</translation>
    </message>
    <message>
        <source>The machine is outside the range the model was made in: %1</source>
        <translation>机床超出建立模型时的范围：%1</translation>
    </message>
    <message>
        <source>The model is out of date: %1 changed after it was fitted.</source>
        <translation>模型已过期：拟合之后“%1”已改变。</translation>
    </message>
    <message>
        <source>The fit leaves up to %1 µm on unseen stretches, above the limit of %2 µm.</source>
        <translation>拟合在未见区段上的残差最大为 %1 µm，超过限值 %2 µm。</translation>
    </message>
    <message>
        <source>Sign: as checked for the version before.</source>
        <translation>符号：沿用前一版本的检查结果。</translation>
    </message>
    <message>
        <source>Sign: checked at %1.</source>
        <translation>符号：已于 %1 检查。</translation>
    </message>
    <message>
        <source>Sign: each axis is first moved by 10 µm and back, watched by the camera.</source>
        <translation>符号：先将各轴移动 10 µm 再移回，由相机观察。</translation>
    </message>
    <message>
        <source>Largest change now: %1 µm in %2.</source>
        <translation>目前最大改变：%2 方向 %1 µm。</translation>
    </message>
    <message>
        <source>Version %1; the machine holds no table now.</source>
        <translation>版本 %1；机床中目前没有补偿表。</translation>
    </message>
    <message>
        <source>Version %1 takes the place of version %2.</source>
        <translation>版本 %1 取代版本 %2。</translation>
    </message>
    <message>
        <source>Axes: %1.</source>
        <translation>轴：%1。</translation>
    </message>
    <message>
        <source>The compensation is off while it is written and on afterwards.</source>
        <translation>写入期间补偿关闭，写入后打开。</translation>
    </message>
    <message numerus="yes">
        <source>%n warning(s), in the details. The first: %1</source>
        <translation>
            <numerusform>%n 条警告，详见详细信息。第一条：%1</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::VerifyPresenter</name>
    <message>
        <source>Verification run</source>
        <translation>验证运行</translation>
    </message>
    <message>
        <source>Judging the residual</source>
        <translation>正在评定残差</translation>
    </message>
    <message>
        <source>Write the table to the machine first; then the run shows what is left.</source>
        <translation>请先将补偿表写入机床；之后的运行显示残余误差。</translation>
    </message>
    <message>
        <source>The machine holds no table: write it in Upload, or bring it back.</source>
        <translation>机床中没有补偿表：请在“上传”步骤中写入或恢复。</translation>
    </message>
    <message>
        <source>The machine holds another table than this job&apos;s: compare them in Upload.</source>
        <translation>机床中的补偿表不是本作业的：请在“上传”步骤中比较。</translation>
    </message>
    <message>
        <source>Above the limit</source>
        <translation>超过限值</translation>
    </message>
    <message>
        <source>The compensation is OFF: switch it on with the lamp below, then start.</source>
        <translation>补偿已断开：请用下方的指示灯接通，然后开始。</translation>
    </message>
    <message>
        <source>Promise not reached</source>
        <translation>未达到拟合的预期</translation>
    </message>
    <message>
        <source>Less than %1 % removed</source>
        <translation>消除不足 %1 %</translation>
    </message>
    <message>
        <source>Finish the interrupted run?</source>
        <translation>结束中断的运行？</translation>
    </message>
    <message>
        <source>What was recorded until the interruption is kept and used.</source>
        <translation>中断前记录的数据将保留并使用。</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>结束</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::WarmupPresenter</name>
    <message>
        <source>Finish the interrupted run?</source>
        <translation>结束被中断的运行？</translation>
    </message>
    <message>
        <source>What was recorded until the interruption is kept and used.</source>
        <translation>中断之前记录的内容将保留并采用。</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>结束</translation>
    </message>
    <message>
        <source>Warm-up plan</source>
        <translation>暖机计划</translation>
    </message>
    <message>
        <source>Plans (*.json)</source>
        <translation>计划 (*.json)</translation>
    </message>
    <message>
        <source>Save as CSV</source>
        <translation>保存为 CSV</translation>
    </message>
    <message>
        <source>Recordings (*.csv)</source>
        <translation>记录 (*.csv)</translation>
    </message>
    <message>
        <source>Save plan</source>
        <translation>保存计划</translation>
    </message>
    <message>
        <source>Warm-up run</source>
        <translation>暖机运行</translation>
    </message>
    <message>
        <source>Calibrate the camera first: without it no error can be measured.</source>
        <translation>请先标定相机：否则无法测量误差。</translation>
    </message>
    <message>
        <source>No machine is connected, so none is stopped: look whether its spindle stands.</source>
        <translation>未连接机床，因此不会停止任何机床：请到现场确认主轴已停止。</translation>
    </message>
    <message>
        <source>Finishing the interrupted run</source>
        <translation>正在结束中断的运行</translation>
    </message>
    <message numerus="yes">
        <source>%n temperatures</source>
        <translation>
            <numerusform>%n 个温度</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n errors</source>
        <translation>
            <numerusform>%n 个误差</numerusform>
        </translation>
    </message>
    <message>
        <source>For the physics alone: it has no %1.</source>
        <translation>仅用于物理分析：缺少 %1。</translation>
    </message>
    <message>
        <source>Tests the fit; explained by the physics.</source>
        <translation>用于检验拟合，并参与物理解释。</translation>
    </message>
    <message>
        <source>Fitted too; explained by the physics.</source>
        <translation>参与拟合和物理解释。</translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::Workbench</name>
    <message>
        <source>Connected to %1</source>
        <translation>已连接 %1</translation>
    </message>
    <message>
        <source>Job %1</source>
        <translation>作业 %1</translation>
    </message>
    <message>
        <source>Kept %1 #%2</source>
        <translation>已保存%1 #%2</translation>
    </message>
    <message>
        <source>A job keeps no password: load the connection profile for the cameras.</source>
        <translation>作业不保存密码：请为相机载入连接配置。</translation>
    </message>
    <message>
        <source>Disconnected: this job is of another machine (serial %1).</source>
        <translation>已断开连接：此作业属于另一台机床（序列号 %1）。</translation>
    </message>
    <message numerus="yes">
        <source>Connected to %1 again, after %n attempt(s) that failed</source>
        <translation>
            <numerusform>已重新连接到 %1，此前失败 %n 次</numerusform>
        </translation>
    </message>
    <message>
        <source>The controller does not answer</source>
        <translation>控制器没有应答</translation>
    </message>
    <message>
        <source>The controller answers again</source>
        <translation>控制器恢复应答</translation>
    </message>
    <message>
        <source>%1 is still running</source>
        <translation>“%1”仍在进行</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::AxisPage</name>
    <message>
        <source>Axis errors</source>
        <translation>轴误差</translation>
    </message>
    <message>
        <source>Beside the main line: the geometric error of each axis, from a laser interferometer.</source>
        <translation>主流程之外：由激光干涉仪测得的各轴几何误差。</translation>
    </message>
    <message>
        <source>Judge the measurement, choose how it is cut into segments, then write the table.</source>
        <translation>评定测量结果，选择分段方式，然后写入补偿表。</translation>
    </message>
    <message>
        <source>Open laser file</source>
        <translation>打开激光文件</translation>
    </message>
    <message>
        <source>Use for upload</source>
        <translation>用于上传</translation>
    </message>
    <message>
        <source>The table is not monotonic: the axis would move backwards somewhere.</source>
        <translation>该表不单调：轴会在某处倒退。</translation>
    </message>
    <message>
        <source>Columns</source>
        <translation>列</translation>
    </message>
    <message>
        <source>Export one point</source>
        <translation>导出单点</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>导出</translation>
    </message>
    <message>
        <source>Accuracy now</source>
        <translation>当前精度</translation>
    </message>
    <message>
        <source>A, ISO 230-2</source>
        <translation>A，ISO 230-2</translation>
    </message>
    <message>
        <source>With the table</source>
        <translation>使用补偿表后</translation>
    </message>
    <message>
        <source>expected</source>
        <translation>预期</translation>
    </message>
    <message>
        <source>better</source>
        <translation>改善</translation>
    </message>
    <message>
        <source>worse</source>
        <translation>变差</translation>
    </message>
    <message>
        <source>Segments</source>
        <translation>分段</translation>
    </message>
    <message>
        <source>fewest</source>
        <translation>最少</translation>
    </message>
    <message>
        <source>as published</source>
        <translation>按公开方法</translation>
    </message>
    <message>
        <source>Largest residual</source>
        <translation>最大残差</translation>
    </message>
    <message>
        <source>There and back</source>
        <translation>往返误差</translation>
    </message>
    <message>
        <source>Forward of inverse against the position itself, largest over the travel.</source>
        <translation>先逆变换再正变换所得位置与原位置之差，全行程最大值。</translation>
    </message>
    <message>
        <source>Drop a laser file here</source>
        <translation>将激光文件拖放到此处</translation>
    </message>
    <message>
        <source>CSV, Renishaw .rtl or .pos with targets and runs. It is checked, drawn with its ISO 230-2 figures, and cut into segments that the controller can use.</source>
        <translation>含目标位置和各次测量的 CSV、Renishaw .rtl 或 .pos 文件。文件将被检查，按 ISO 230-2 指标绘图，并分成控制器可用的线段。</translation>
    </message>
    <message>
        <source>Measurement</source>
        <translation>测量</translation>
    </message>
    <message>
        <source>Axis %1</source>
        <translation>轴 %1</translation>
    </message>
    <message>
        <source>Cut into segments</source>
        <translation>分段方式</translation>
    </message>
    <message>
        <source>Criterion</source>
        <translation>判据</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>容差</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>阈值</translation>
    </message>
    <message>
        <source>First points</source>
        <translation>起始点数</translation>
    </message>
    <message>
        <source>r on coordinates</source>
        <translation>坐标的 r</translation>
    </message>
    <message>
        <source>r on errors</source>
        <translation>误差的 r</translation>
    </message>
    <message>
        <source>tolerance in µm</source>
        <translation>容差（µm）</translation>
    </message>
    <message>
        <source>On coordinates r is about 1 whatever the error: it hardly cuts.</source>
        <translation>按坐标计算时，无论误差大小 r 都约为 1：几乎不会分段。</translation>
    </message>
    <message>
        <source>Export as</source>
        <translation>导出为</translation>
    </message>
    <message>
        <source>Format of the export</source>
        <translation>导出格式</translation>
    </message>
    <message>
        <source>The format loses nothing.</source>
        <translation>该格式没有损失。</translation>
    </message>
    <message>
        <source>Lost in this format: %1.</source>
        <translation>该格式的损失：%1。</translation>
    </message>
    <message>
        <source>Largest difference %1 µm.</source>
        <translation>最大差异 %1 µm。</translation>
    </message>
    <message>
        <source>Confirm on one point first: %1.</source>
        <translation>请先用一个点确认：%1。</translation>
    </message>
    <message>
        <source>Rule</source>
        <translation>方法</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Largest of a measured point, µm</source>
        <translation>测量点的最大值，µm</translation>
    </message>
    <message>
        <source>Fewest within %1 µm</source>
        <translation>%1 µm 内的最少分段</translation>
    </message>
    <message>
        <source>As published</source>
        <translation>按公开方法</translation>
    </message>
    <message>
        <source>Figures</source>
        <translation>指标</translation>
    </message>
    <message>
        <source>Figure</source>
        <translation>指标</translation>
    </message>
    <message>
        <source>Meaning</source>
        <translation>含义</translation>
    </message>
    <message>
        <source>From</source>
        <translation>自</translation>
    </message>
    <message>
        <source>To</source>
        <translation>至</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>点数</translation>
    </message>
    <message>
        <source>Largest residual of a point</source>
        <translation>一个点的最大残差</translation>
    </message>
    <message>
        <source>joint</source>
        <translation>连接点</translation>
    </message>
    <message>
        <source>mean of both</source>
        <translation>双向平均值</translation>
    </message>
    <message>
        <source>segments used</source>
        <translation>采用的线段</translation>
    </message>
    <message>
        <source>the other rule</source>
        <translation>另一种方法</translation>
    </message>
    <message>
        <source>mean up</source>
        <translation>正向平均值</translation>
    </message>
    <message>
        <source>mean down</source>
        <translation>负向平均值</translation>
    </message>
    <message>
        <source>± 2 s</source>
        <translation>± 2 s</translation>
    </message>
    <message>
        <source>reversal B</source>
        <translation>反向差值 B</translation>
    </message>
    <message>
        <source>runs</source>
        <translation>各次测量</translation>
    </message>
    <message>
        <source>position / mm</source>
        <translation>位置 / mm</translation>
    </message>
    <message>
        <source>error / µm</source>
        <translation>误差 / µm</translation>
    </message>
    <message>
        <source>Mean ± 2 s</source>
        <translation>平均值 ± 2 s</translation>
    </message>
    <message>
        <source>Run %1 upwards</source>
        <translation>第 %1 次，正向</translation>
    </message>
    <message>
        <source>Run %1 downwards</source>
        <translation>第 %1 次，负向</translation>
    </message>
    <message>
        <source>Mean upwards</source>
        <translation>正向平均值</translation>
    </message>
    <message>
        <source>Mean downwards</source>
        <translation>负向平均值</translation>
    </message>
    <message>
        <source>Reversal</source>
        <translation>反向差值</translation>
    </message>
    <message>
        <source>A = %1 µm</source>
        <translation>A = %1 µm</translation>
    </message>
    <message>
        <source>Mean of both directions</source>
        <translation>双向平均值</translation>
    </message>
    <message>
        <source>Reads what an interferometer measured along one axis</source>
        <translation>读取干涉仪沿一根轴测得的数据</translation>
    </message>
    <message>
        <source>Keeps the table in the job; the next upload writes it with the model</source>
        <translation>把表保存在作业中；下次上传时与模型一起写入</translation>
    </message>
    <message>
        <source>Another measurement, of this axis or of another</source>
        <translation>另一次测量，可以是此轴或其他轴</translation>
    </message>
    <message>
        <source>Which column of the file is what</source>
        <translation>文件各列的含义</translation>
    </message>
    <message>
        <source>A table of one point, to try the sign on the machine</source>
        <translation>只有一个点的表，用于在机床上检验符号</translation>
    </message>
    <message>
        <source>The table as a file for a controller</source>
        <translation>供控制器使用的表文件</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::CalibratePage</name>
    <message>
        <source>Calibrate</source>
        <translation>标定</translation>
    </message>
    <message>
        <source>Point the camera at the target, set focus and light, then draw the target&apos;s region.</source>
        <translation>将相机对准靶标，调好焦距和光照，然后画出靶标区域。</translation>
    </message>
    <message>
        <source>Camera %1 comes next: confirm that its axes may move, then measure.</source>
        <translation>接下来是相机 %1：确认其对应的轴可以移动，然后测量。</translation>
    </message>
    <message>
        <source>The axes go from position to position. Keep hands and doors away.</source>
        <translation>各轴依次移动到各位置。请勿将手或防护门伸入。</translation>
    </message>
    <message>
        <source>This camera is calibrated. Measure again when it was touched.</source>
        <translation>该相机已标定。若触碰过相机，请重新测量。</translation>
    </message>
    <message>
        <source>Judge the residuals: they must be small and without pattern. Then accept.</source>
        <translation>评定残差：应当小且无规律。然后接受。</translation>
    </message>
    <message>
        <source>Confirm that the axes may move, then measure the positions.</source>
        <translation>确认各轴可以移动，然后测量各位置。</translation>
    </message>
    <message>
        <source>Measure positions</source>
        <translation>测量各位置</translation>
    </message>
    <message>
        <source>Take the template</source>
        <translation>拍摄模板</translation>
    </message>
    <message>
        <source>Accept</source>
        <translation>接受</translation>
    </message>
    <message>
        <source>The residual is above the limit. Measure again, slower or with better light.</source>
        <translation>残差超过限值。请降低速度或改善光照后重新测量。</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>继续</translation>
    </message>
    <message>
        <source>The positions are being measured.</source>
        <translation>正在测量各位置。</translation>
    </message>
    <message>
        <source>Confirm first that the axes may move.</source>
        <translation>请先确认各轴可以移动。</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>重新测量</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>比例</translation>
    </message>
    <message>
        <source>µm/px</source>
        <translation>µm/px</translation>
    </message>
    <message>
        <source>Camera rotation</source>
        <translation>相机转角</translation>
    </message>
    <message>
        <source>Taken out by the calibration; it needs no turning of the camera.</source>
        <translation>由标定消除，无需转动相机。</translation>
    </message>
    <message>
        <source>Positions</source>
        <translation>位置数</translation>
    </message>
    <message>
        <source>of %1</source>
        <translation>共 %1</translation>
    </message>
    <message>
        <source>%1 left</source>
        <translation>剩余 %1</translation>
    </message>
    <message>
        <source>Residual, rms</source>
        <translation>残差 rms</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>不确定度</translation>
    </message>
    <message>
        <source>No camera to calibrate</source>
        <translation>没有需要标定的相机</translation>
    </message>
    <message>
        <source>Live image</source>
        <translation>实时图像</translation>
    </message>
    <message>
        <source>Draw region</source>
        <translation>画区域</translation>
    </message>
    <message>
        <source>Draw a box around the target in the image</source>
        <translation>在图像中框出靶标</translation>
    </message>
    <message>
        <source>Waiting for the camera</source>
        <translation>等待相机</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Plan</source>
        <translation>计划</translation>
    </message>
    <message>
        <source>The positions are proposed after the template</source>
        <translation>拍摄模板后给出建议位置</translation>
    </message>
    <message>
        <source>Field of view</source>
        <translation>视场</translation>
    </message>
    <message>
        <source>Expected drift</source>
        <translation>预期漂移</translation>
    </message>
    <message>
        <source>Planned</source>
        <translation>计划</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>当前</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>已测量</translation>
    </message>
    <message>
        <source>Refused</source>
        <translation>已拒绝</translation>
    </message>
    <message>
        <source>Shown when the positions are measured</source>
        <translation>测量各位置后显示</translation>
    </message>
    <message>
        <source>Dashed: field of view. Blue: expected drift; the positions must enclose it.</source>
        <translation>虚线：视场。蓝色：预期漂移；各位置必须将其包围。</translation>
    </message>
    <message>
        <source>%1 µm</source>
        <translation>%1 µm</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>位置</translation>
    </message>
    <message>
        <source>Residual vectors drawn %1 times larger.</source>
        <translation>残差矢量放大 %1 倍绘制。</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>good</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>对焦</translation>
    </message>
    <message>
        <source>blurred</source>
        <translation>模糊</translation>
    </message>
    <message>
        <source>Exposure</source>
        <translation>曝光</translation>
    </message>
    <message>
        <source>%1 % too bright</source>
        <translation>%1 % 过亮</translation>
    </message>
    <message>
        <source>too dark</source>
        <translation>过暗</translation>
    </message>
    <message>
        <source>too bright</source>
        <translation>过亮</translation>
    </message>
    <message>
        <source>Moves</source>
        <translation>移动</translation>
    </message>
    <message>
        <source>camera %1, %2 of %3</source>
        <translation>相机 %1，第 %2 个，共 %3 个</translation>
    </message>
    <message>
        <source>%1 and %2</source>
        <translation>%1 和 %2</translation>
    </message>
    <message>
        <source> and </source>
        <translation> 和 </translation>
    </message>
    <message>
        <source>%1 may move by ±%2 mm; the area is clear.</source>
        <translation>%1 可移动 ±%2 mm；工作区已清空。</translation>
    </message>
    <message>
        <source>First the machine drives to %1; an axis not named here stays where it is.</source>
        <translation>机床先移动到 %1；这里没有列出的轴保持不动。</translation>
    </message>
    <message>
        <source>Before the next camera is calibrated, you are asked again.</source>
        <translation>标定下一台相机之前会再次询问。</translation>
    </message>
    <message>
        <source>Measuring positions</source>
        <translation>测量位置</translation>
    </message>
    <message>
        <source>Without a reference mark the camera&apos;s own drift stays in the errors: some 2 µm for each K that 100 mm of its aluminium bracket warm up.</source>
        <translation>没有参考标记时，相机自身的漂移会留在误差中：100 mm 长的铝支架每升温 1 K 约 2 µm。</translation>
    </message>
    <message>
        <source>The reference marks take out that the camera shifts, turns or changes its scale. A mark that itself moves would still be in the errors.</source>
        <translation>参考标记可消除相机的平移、转动和比例变化。标记自身的移动仍会留在误差中。</translation>
    </message>
    <message>
        <source>That it turns or changes its scale stays in the errors.</source>
        <translation>相机的转动或比例变化仍留在误差中。</translation>
    </message>
    <message>
        <source>That it turns or changes its scale stays in the errors: %1 µm for 0.1 mrad or 1 in 10 000.</source>
        <translation>相机的转动或比例变化仍留在误差中：每 0.1 mrad 或万分之一为 %1 µm。</translation>
    </message>
    <message>
        <source>The reference mark takes out that the camera shifts.</source>
        <translation>参考标记可消除相机的平移。</translation>
    </message>
    <message>
        <source>The reference marks stand too close together: they take out only that the camera shifts.</source>
        <translation>参考标记相距太近：只能消除相机的平移。</translation>
    </message>
    <message numerus="yes">
        <source>%n reference mark(s)</source>
        <translation>
            <numerusform>%n 个参考标记</numerusform>
        </translation>
    </message>
    <message>
        <source>Marks</source>
        <translation>标记</translation>
    </message>
    <message>
        <source>Fixed marks on the table, which show the camera&apos;s own drift; two, well apart, show its turn too</source>
        <translation>工作台上的固定标记，显示相机自身的漂移；两个相距较远的标记还能显示其转动</translation>
    </message>
    <message>
        <source>Add a mark</source>
        <translation>添加标记</translation>
    </message>
    <message>
        <source>Remove the mark</source>
        <translation>移除标记</translation>
    </message>
    <message>
        <source>Remove mark %1</source>
        <translation>移除标记 %1</translation>
    </message>
    <message>
        <source>draw a box around the mark</source>
        <translation>请框选标记</translation>
    </message>
    <message>
        <source>no reference mark</source>
        <translation>无参考标记</translation>
    </message>
    <message>
        <source>Pictures of the target at rest, with which all later ones are compared</source>
        <translation>靶标静止时的图像，之后的图像都与它比较</translation>
    </message>
    <message>
        <source>Keeps scale and directions of the cameras in the job</source>
        <translation>把相机的比例和方向保存在作业中</translation>
    </message>
    <message>
        <source>Moves the axes by some millimetres at most and finds how many µm a pixel is</source>
        <translation>各轴最多移动几毫米，求出每个像素对应多少 µm</translation>
    </message>
    <message>
        <source>Takes a new template and measures all positions anew</source>
        <translation>重新拍摄模板并重新测量所有位置</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::CameraView</name>
    <message>
        <source>Camera image</source>
        <translation>相机图像</translation>
    </message>
    <message>
        <source>No image from the camera</source>
        <translation>没有来自相机的图像</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>参考标记</translation>
    </message>
    <message>
        <source>Target</source>
        <translation>靶标</translation>
    </message>
    <message>
        <source>drift × %1</source>
        <translation>漂移 × %1</translation>
    </message>
    <message>
        <source>± %1 px, drawn %2 ×</source>
        <translation>± %1 px，放大 %2 倍绘制</translation>
    </message>
    <message>
        <source>Reference %1</source>
        <translation>参考标记 %1</translation>
    </message>
    <message>
        <source>%1: not seen</source>
        <translation>%1：未识别</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ChannelTable</name>
    <message>
        <source>Channel</source>
        <translation>通道</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>数值</translation>
    </message>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ColumnDialog</name>
    <message>
        <source>not used</source>
        <translation>不使用</translation>
    </message>
    <message>
        <source>position</source>
        <translation>位置</translation>
    </message>
    <message>
        <source>error</source>
        <translation>误差</translation>
    </message>
    <message>
        <source>error, upwards</source>
        <translation>误差，正向</translation>
    </message>
    <message>
        <source>error, downwards</source>
        <translation>误差，负向</translation>
    </message>
    <message>
        <source>measured position</source>
        <translation>实测位置</translation>
    </message>
    <message>
        <source>measured, upwards</source>
        <translation>实测，正向</translation>
    </message>
    <message>
        <source>measured, downwards</source>
        <translation>实测，负向</translation>
    </message>
    <message>
        <source>direction</source>
        <translation>方向</translation>
    </message>
    <message>
        <source>run</source>
        <translation>测量次序</translation>
    </message>
    <message>
        <source>Columns of the laser table</source>
        <translation>激光数据表的列</translation>
    </message>
    <message>
        <source>Say what each column holds. Errors are actual minus commanded position.</source>
        <translation>请指明每列的内容。误差为实际位置减去指令位置。</translation>
    </message>
    <message>
        <source>Column %1</source>
        <translation>第 %1 列</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>µm</source>
        <translation>µm</translation>
    </message>
    <message>
        <source>inch</source>
        <translation>英寸</translation>
    </message>
    <message>
        <source>The file holds compensations (turn the sign)</source>
        <translation>文件中为补偿值（符号取反）</translation>
    </message>
    <message>
        <source>Rows towards smaller positions are the downward approach</source>
        <translation>位置递减的行为负向趋近</translation>
    </message>
    <message>
        <source>Positions in</source>
        <translation>位置单位</translation>
    </message>
    <message>
        <source>Errors in</source>
        <translation>误差单位</translation>
    </message>
    <message>
        <source>Use these columns</source>
        <translation>使用这些列</translation>
    </message>
    <message>
        <source>microinch</source>
        <translation>微英寸</translation>
    </message>
    <message>
        <source>mil (0.001 inch)</source>
        <translation>密耳（0.001 英寸）</translation>
    </message>
    <message>
        <source>0.0001 inch</source>
        <translation>0.0001 英寸</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::CommandPalette</name>
    <message>
        <source>Find a step, a sensor or an action</source>
        <translation>查找步骤、传感器或操作</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::CompanyDialog</name>
    <message>
        <source>Your company in the report</source>
        <translation>报告中的贵公司信息</translation>
    </message>
    <message>
        <source>Logo and address stand at the head of every report from this computer.</source>
        <translation>徽标和地址显示在本计算机生成的每份报告的抬头。</translation>
    </message>
    <message>
        <source>Choose a picture</source>
        <translation>选择图片</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Name and address</source>
        <translation>名称和地址</translation>
    </message>
    <message>
        <source>Logo</source>
        <translation>徽标</translation>
    </message>
    <message>
        <source>Use</source>
        <translation>使用</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>%1 is no picture that can be read: choose a PNG, JPEG or SVG file.</source>
        <translation>%1 不是可读取的图片：请选择 PNG、JPEG 或 SVG 文件。</translation>
    </message>
    <message>
        <source>Pictures (*.png *.jpg *.jpeg *.svg)</source>
        <translation>图片 (*.png *.jpg *.jpeg *.svg)</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::CompensatorPage</name>
    <message>
        <source>%1 predicted</source>
        <translation>%1 预测</translation>
    </message>
    <message>
        <source>%1 applied</source>
        <translation>%1 已施加</translation>
    </message>
    <message>
        <source>%1 left</source>
        <translation>%1 残余</translation>
    </message>
    <message>
        <source>Host compensator</source>
        <translation>上位机补偿器</translation>
    </message>
    <message>
        <source>This computer compensates: for controllers without a table of their own, and for models that remember.</source>
        <translation>由本计算机进行补偿：用于没有补偿表的控制器，以及带历史记忆的模型。</translation>
    </message>
    <message>
        <source>Temperatures are read, the model predicts, the controller gets the offset. Keep this computer connected.</source>
        <translation>读取温度，模型预测，偏置发送给控制器。请保持本计算机连接。</translation>
    </message>
    <message>
        <source>The offset runs to 0.</source>
        <translation>偏置正在归零。</translation>
    </message>
    <message>
        <source>Start compensating</source>
        <translation>开始补偿</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>停止</translation>
    </message>
    <message>
        <source>The offset runs to 0 at the machine&apos;s rate.</source>
        <translation>偏置按机床的速率归零。</translation>
    </message>
    <message>
        <source>Nothing to compensate with yet</source>
        <translation>尚不能补偿</translation>
    </message>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
    <message>
        <source>off</source>
        <translation>断开</translation>
    </message>
    <message>
        <source>as it should</source>
        <translation>正常</translation>
    </message>
    <message>
        <source>see at the right</source>
        <translation>见右侧</translation>
    </message>
    <message>
        <source>for %1</source>
        <translation>已 %1</translation>
    </message>
    <message>
        <source>Left now</source>
        <translation>当前残余</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>未测量</translation>
    </message>
    <message>
        <source>Most left</source>
        <translation>最大残余</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>实测</translation>
    </message>
    <message>
        <source>Turns</source>
        <translation>周期数</translation>
    </message>
    <message>
        <source>none lost</source>
        <translation>无丢失</translation>
    </message>
    <message>
        <source>%1 lost</source>
        <translation>丢失 %1 个</translation>
    </message>
    <message>
        <source>Latest turn</source>
        <translation>最大延迟</translation>
    </message>
    <message>
        <source>Prediction, compensation and what is left</source>
        <translation>预测、补偿与残余误差</translation>
    </message>
    <message>
        <source>1 min</source>
        <translation>1 min</translation>
    </message>
    <message>
        <source>10 min</source>
        <translation>10 min</translation>
    </message>
    <message>
        <source>All</source>
        <translation>全部</translation>
    </message>
    <message>
        <source>error predicted by the model</source>
        <translation>模型预测的误差</translation>
    </message>
    <message>
        <source>compensation applied</source>
        <translation>施加的补偿</translation>
    </message>
    <message>
        <source>left, measured</source>
        <translation>残余，实测</translation>
    </message>
    <message>
        <source>Waiting for the first turn</source>
        <translation>等待第一个周期</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>当前</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>轴</translation>
    </message>
    <message>
        <source>Predicted</source>
        <translation>预测</translation>
    </message>
    <message>
        <source>Error = actual − commanded, as the model says</source>
        <translation>误差 = 实际 − 指令，按模型</translation>
    </message>
    <message>
        <source>Applied</source>
        <translation>已施加</translation>
    </message>
    <message>
        <source>Compensation, as the controller tells</source>
        <translation>补偿量，由控制器报告</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>残余</translation>
    </message>
    <message>
        <source>Error as measured, with the compensation</source>
        <translation>补偿接通时实测的误差</translation>
    </message>
    <message>
        <source>Nothing is measured: %1.</source>
        <translation>未进行测量：%1。</translation>
    </message>
    <message>
        <source>No offset is larger than %1 µm. If this computer or the cable fails, the controller takes the offset out by itself.</source>
        <translation>任何偏置都不超过 %1 µm。若本计算机或电缆发生故障，控制器会自行撤销偏置。</translation>
    </message>
    <message>
        <source>Drawn while this computer compensates</source>
        <translation>由本计算机补偿时在此绘出</translation>
    </message>
    <message>
        <source>This computer sends the predicted error to the machine as an offset until it is stopped</source>
        <translation>本计算机把预测误差作为偏置发送给机床，直到停止</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ComponentDrawing</name>
    <message>
        <source>Component with heat sources and sensors</source>
        <translation>部件及其热源和传感器</translation>
    </message>
    <message>
        <source>recommended sensor region %1 to %2 mm</source>
        <translation>推荐的传感器区域 %1 至 %2 mm</translation>
    </message>
    <message>
        <source>mismatch %1 to %2 mm</source>
        <translation>不一致 %1 至 %2 mm</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ExplanationCard</name>
    <message>
        <source>adopted</source>
        <translation>已采纳</translation>
    </message>
    <message>
        <source>rejected</source>
        <translation>已否决</translation>
    </message>
    <message>
        <source>sure</source>
        <translation>确定</translation>
    </message>
    <message>
        <source>possible</source>
        <translation>可能</translation>
    </message>
    <message>
        <source>%1, %2 %</source>
        <translation>%1，%2 %</translation>
    </message>
    <message>
        <source>Take out again</source>
        <translation>撤销采纳</translation>
    </message>
    <message>
        <source>Adopt</source>
        <translation>采纳</translation>
    </message>
    <message>
        <source>Reject</source>
        <translation>否决</translation>
    </message>
    <message>
        <source>&lt;span style=&apos;color:%1&apos;&gt;%8 before %2&lt;/span&gt;&lt;br&gt;&lt;span style=&apos;color:%3&apos;&gt;only re-fitted %4&lt;/span&gt;&lt;br&gt;&lt;span style=&apos;color:%5&apos;&gt;with the effect %6 %7&lt;/span&gt;</source>
        <translation>&lt;span style=&apos;color:%1&apos;&gt;%8 之前 %2&lt;/span&gt;&lt;br&gt;&lt;span style=&apos;color:%3&apos;&gt;仅重新拟合 %4&lt;/span&gt;&lt;br&gt;&lt;span style=&apos;color:%5&apos;&gt;计入该效应 %6 %7&lt;/span&gt;</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::FigureCard</name>
    <message>
        <source>no value yet</source>
        <translation>尚无数值</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::FitPage</name>
    <message>
        <source>Fit</source>
        <translation>拟合</translation>
    </message>
    <message>
        <source>Judge the model on stretches it has not seen. Only then is it worth writing to the machine.</source>
        <translation>用模型未见过的数据段评定模型。合格后才值得写入机床。</translation>
    </message>
    <message>
        <source>Use this model</source>
        <translation>使用此模型</translation>
    </message>
    <message>
        <source>Attainable peak error</source>
        <translation>可达到的误差峰值</translation>
    </message>
    <message>
        <source>Valid</source>
        <translation>有效范围</translation>
    </message>
    <message>
        <source>Removed</source>
        <translation>消除</translation>
    </message>
    <message>
        <source>Band coverage</source>
        <translation>预测带覆盖率</translation>
    </message>
    <message>
        <source>fitted</source>
        <translation>参与拟合</translation>
    </message>
    <message>
        <source>unseen</source>
        <translation>未参与拟合</translation>
    </message>
    <message>
        <source>No model yet</source>
        <translation>尚无模型</translation>
    </message>
    <message>
        <source>Prediction</source>
        <translation>预测</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Measured and predicted</source>
        <translation>实测与预测</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>实测</translation>
    </message>
    <message>
        <source>predicted</source>
        <translation>预测</translation>
    </message>
    <message>
        <source>prediction band</source>
        <translation>预测带</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>已测量</translation>
    </message>
    <message>
        <source>Predicted</source>
        <translation>预测</translation>
    </message>
    <message>
        <source>measured - predicted</source>
        <translation>实测 - 预测</translation>
    </message>
    <message>
        <source>time</source>
        <translation>时间</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>leading sensor / °C</source>
        <translation>主要传感器 / °C</translation>
    </message>
    <message>
        <source>residual / µm</source>
        <translation>残差 / µm</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>方法</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>方法</translation>
    </message>
    <message>
        <source>rms</source>
        <translation>rms</translation>
    </message>
    <message>
        <source>Root mean square of what is left</source>
        <translation>残余误差的均方根</translation>
    </message>
    <message>
        <source>Peak</source>
        <translation>峰值</translation>
    </message>
    <message>
        <source>Band</source>
        <translation>预测带</translation>
    </message>
    <message>
        <source>Share of the measurements inside the stated band</source>
        <translation>落在所给预测带内的测量比例</translation>
    </message>
    <message>
        <source>Runs on</source>
        <translation>运行于</translation>
    </message>
    <message>
        <source>Controller: it can compute the model itself. Host: this computer must stay connected.</source>
        <translation>控制器：控制器可自行计算该模型。上位机：本计算机必须保持连接。</translation>
    </message>
    <message>
        <source>Proposed: %1</source>
        <translation>推荐：%1</translation>
    </message>
    <message>
        <source>controller</source>
        <translation>控制器</translation>
    </message>
    <message>
        <source>host</source>
        <translation>上位机</translation>
    </message>
    <message>
        <source>What to expect</source>
        <translation>预期效果</translation>
    </message>
    <message>
        <source>Choose a method to see what it will leave.</source>
        <translation>选择一种方法，查看其残余误差。</translation>
    </message>
    <message>
        <source>From %1.</source>
        <translation>依据：%1。</translation>
    </message>
    <message>
        <source>Update by a new run…</source>
        <translation>用新的运行更新…</translation>
    </message>
    <message>
        <source>Machines age. A recording of half an hour corrects this model instead of starting over: what it does not excite stays as it was.</source>
        <translation>机床会老化。用半小时的记录即可修正此模型，无需重新开始：记录中未激励的部分保持不变。</translation>
    </message>
    <message>
        <source>Corrected by the newer run %1.</source>
        <translation>已按较新的运行 %1 修正。</translation>
    </message>
    <message>
        <source>Largest single error of the worst axis that stays on unseen stretches.</source>
        <translation>未参与拟合的数据段上最差轴残留的最大单次误差。</translation>
    </message>
    <message>
        <source>on unseen stretches, mean of the axes</source>
        <translation>未参与拟合的数据段，各轴平均</translation>
    </message>
    <message>
        <source>Left %1 µm rms in the worst axis on the end of the run; one cycle says nothing about other speeds.</source>
        <translation>运行末段最差轴残余 %1 µm（rms）；单个循环无法说明其他转速下的情况。</translation>
    </message>
    <message>
        <source>Will leave %1 µm rms in the worst axis (90 %: %2 µm) at speeds like these.</source>
        <translation>在类似转速下最差轴残余 %1 µm rms（90 %：%2 µm）。</translation>
    </message>
    <message>
        <source>Why: %1.</source>
        <translation>原因：%1。</translation>
    </message>
    <message>
        <source>Will leave %1 µm rms in the worst axis at speeds like these.</source>
        <translation>在类似转速下最差轴残余 %1 µm rms。</translation>
    </message>
    <message>
        <source>Fit the model</source>
        <translation>拟合模型</translation>
    </message>
    <message>
        <source>Fit again</source>
        <translation>重新拟合</translation>
    </message>
    <message>
        <source>Fit a model first.</source>
        <translation>请先拟合模型。</translation>
    </message>
    <message>
        <source>Out of date: %1 changed after this model was fitted. Fit again.</source>
        <translation>已过期：拟合此模型后%1已更改。请重新拟合。</translation>
    </message>
    <message>
        <source>Finds how the errors follow the chosen sensors, and tests it on stretches it has not seen</source>
        <translation>求出误差与所选传感器的关系，并在未用于拟合的区段上检验</translation>
    </message>
    <message>
        <source>The sensors or the recordings have changed since the last fit</source>
        <translation>上次拟合之后，传感器或记录已改变</translation>
    </message>
    <message>
        <source>Goes on: the table is made of this model</source>
        <translation>继续：由此模型生成表</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::HelpPanel</name>
    <message>
        <source>Help for this step</source>
        <translation>本步骤帮助</translation>
    </message>
    <message>
        <source>Close (F1)</source>
        <translation>关闭（F1）</translation>
    </message>
    <message>
        <source>Close the help</source>
        <translation>关闭帮助</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>快捷键</translation>
    </message>
    <message>
        <source>About, licences</source>
        <translation>关于、许可证</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ImportDialog</name>
    <message>
        <source>not used</source>
        <translation>不使用</translation>
    </message>
    <message>
        <source>time</source>
        <translation>时间</translation>
    </message>
    <message>
        <source>temperature</source>
        <translation>温度</translation>
    </message>
    <message>
        <source>room temperature</source>
        <translation>室温</translation>
    </message>
    <message>
        <source>displacement</source>
        <translation>位移</translation>
    </message>
    <message>
        <source>tilt</source>
        <translation>倾角</translation>
    </message>
    <message>
        <source>spindle speed</source>
        <translation>主轴转速</translation>
    </message>
    <message>
        <source>coolant</source>
        <translation>冷却液</translation>
    </message>
    <message>
        <source>spindle load</source>
        <translation>主轴负载</translation>
    </message>
    <message>
        <source>other input</source>
        <translation>其他输入</translation>
    </message>
    <message>
        <source>by unit</source>
        <translation>按单位</translation>
    </message>
    <message>
        <source>format, e.g. %d.%m.%Y %H:%M:%S</source>
        <translation>格式，如 %d.%m.%Y %H:%M:%S</translation>
    </message>
    <message numerus="yes">
        <source>and %n more</source>
        <translation>
            <numerusform>另有 %n 条</numerusform>
        </translation>
    </message>
    <message>
        <source>Import a recording</source>
        <translation>导入记录</translation>
    </message>
    <message>
        <source>Column of the file</source>
        <translation>文件中的列</translation>
    </message>
    <message>
        <source>is</source>
        <translation>是</translation>
    </message>
    <message>
        <source>Channel</source>
        <translation>通道</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>单位</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>比例</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>轴</translation>
    </message>
    <message>
        <source>Location or format</source>
        <translation>位置或格式</translation>
    </message>
    <message>
        <source>Decimal sign</source>
        <translation>小数符号</translation>
    </message>
    <message>
        <source>Separator</source>
        <translation>分隔符</translation>
    </message>
    <message>
        <source>Sheet</source>
        <translation>工作表</translation>
    </message>
    <message>
        <source>as found</source>
        <translation>按文件</translation>
    </message>
    <message>
        <source>point</source>
        <translation>点</translation>
    </message>
    <message>
        <source>comma</source>
        <translation>逗号</translation>
    </message>
    <message>
        <source>semicolon</source>
        <translation>分号</translation>
    </message>
    <message>
        <source>tab</source>
        <translation>制表符</translation>
    </message>
    <message>
        <source>blanks</source>
        <translation>空格</translation>
    </message>
    <message>
        <source>Load map</source>
        <translation>载入映射</translation>
    </message>
    <message>
        <source>What the columns are, from a file that was saved for another recording of this logger</source>
        <translation>各列的含义，取自为该记录仪的另一记录保存的文件</translation>
    </message>
    <message>
        <source>Save map</source>
        <translation>保存映射</translation>
    </message>
    <message>
        <source>Keeps what the columns are, for the next recording of this logger</source>
        <translation>保存各列的含义，供该记录仪的下一个记录使用</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Missing</source>
        <translation>缺失</translation>
    </message>
    <message>
        <source>further words</source>
        <translation>其他字样</translation>
    </message>
    <message>
        <source>Words that stand for a missing sample in this file, with commas between them</source>
        <translation>在此文件中表示缺失采样的字样，以逗号分隔</translation>
    </message>
    <message>
        <source>Take as</source>
        <translation>用作</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ItemForm</name>
    <message>
        <source>Add</source>
        <translation>添加</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>撤消</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::LegendRow</name>
    <message>
        <source>Curves: %1</source>
        <translation>曲线：%1</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::LivePlot</name>
    <message>
        <source>%1 rpm</source>
        <translation>%1 r/min</translation>
    </message>
    <message>
        <source>coolant</source>
        <translation>冷却液</translation>
    </message>
    <message>
        <source> · coolant</source>
        <translation> · 冷却液</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::LogDrawer</name>
    <message>
        <source>What happened</source>
        <translation>事件记录</translation>
    </message>
    <message>
        <source>Copy all</source>
        <translation>全部复制</translation>
    </message>
    <message>
        <source>Close (Ctrl+L)</source>
        <translation>关闭（Ctrl+L）</translation>
    </message>
    <message>
        <source>Close the log</source>
        <translation>关闭日志</translation>
    </message>
    <message>
        <source>Log</source>
        <translation>日志</translation>
    </message>
    <message>
        <source>(%1 times, last %2)</source>
        <translation>（%1 次，最后 %2）</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::MachineDialog</name>
    <message>
        <source>Describe the machine</source>
        <translation>描述机床</translation>
    </message>
    <message>
        <source>Enter what a drawing and the data sheets say. What is not known may stay empty where it says so.</source>
        <translation>请填写图纸和数据手册中的值。注明可空的项目，未知时可留空。</translation>
    </message>
    <message>
        <source>Open machine.json</source>
        <translation>打开 machine.json</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>导出</translation>
    </message>
    <message>
        <source>Saves the description as machine.json, for the command line and for another job</source>
        <translation>将描述保存为 machine.json，供命令行和其他作业使用</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Use this description</source>
        <translation>使用此描述</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::MachineDrawing</name>
    <message>
        <source>Machine with its sensors</source>
        <translation>机床及其传感器</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::MachinePage</name>
    <message>
        <source>Machine</source>
        <translation>机床</translation>
    </message>
    <message>
        <source>Start a job for this machine, or go on with one.</source>
        <translation>为该机床新建作业，或继续已有作业。</translation>
    </message>
    <message>
        <source>Choose the connection profile and connect to the controller.</source>
        <translation>选择连接配置文件，并连接控制器。</translation>
    </message>
    <message>
        <source>Switch the compensation off: with it on, nothing can be measured for the model.</source>
        <translation>请断开补偿：补偿接通时无法测量建模数据。</translation>
    </message>
    <message>
        <source>%1 still changes by %2 K/h. You may start; the run is best when nothing changes any more.</source>
        <translation>%1 仍以 %2 K/h 变化。可以开始，但最好等到不再变化。</translation>
    </message>
    <message>
        <source>%1 stands %2 K apart from the others and rests there: that does no harm. Start when all sensors live.</source>
        <translation>%1 与其他传感器相差 %2 K 且保持稳定，没有影响。所有传感器正常后即可开始。</translation>
    </message>
    <message>
        <source>Check that every sensor is alive and the machine is at rest and of even temperature.</source>
        <translation>检查各传感器是否正常，机床是否静止且温度均匀。</translation>
    </message>
    <message>
        <source>Connect</source>
        <translation>连接</translation>
    </message>
    <message>
        <source>The connection is being made.</source>
        <translation>正在建立连接。</translation>
    </message>
    <message>
        <source>Choose or import a connection profile first.</source>
        <translation>请先选择或导入连接配置文件。</translation>
    </message>
    <message>
        <source>Start commissioning</source>
        <translation>开始调试</translation>
    </message>
    <message>
        <source>The compensation is ON. Measuring for the model is locked until it is switched off.</source>
        <translation>补偿处于接通状态。断开之前，禁止测量建模数据。</translation>
    </message>
    <message>
        <source>Import profile</source>
        <translation>导入配置文件</translation>
    </message>
    <message>
        <source>Other job</source>
        <translation>其他作业</translation>
    </message>
    <message>
        <source>Test again</source>
        <translation>重新测试</translation>
    </message>
    <message>
        <source>Disconnect</source>
        <translation>断开连接</translation>
    </message>
    <message>
        <source>Sensors alive</source>
        <translation>正常的传感器</translation>
    </message>
    <message>
        <source>of %1</source>
        <translation>共 %1</translation>
    </message>
    <message>
        <source>all</source>
        <translation>全部</translation>
    </message>
    <message numerus="yes">
        <source>%n to check</source>
        <translation>
            <numerusform>%n 个待检查</numerusform>
        </translation>
    </message>
    <message>
        <source>Clock difference</source>
        <translation>时钟差</translation>
    </message>
    <message>
        <source>Controller&apos;s clock minus this computer&apos;s.</source>
        <translation>控制器时钟减去本计算机时钟。</translation>
    </message>
    <message>
        <source>Round trip</source>
        <translation>往返时间</translation>
    </message>
    <message>
        <source>Spread at rest</source>
        <translation>静止时温差</translation>
    </message>
    <message>
        <source>even</source>
        <translation>均匀</translation>
    </message>
    <message>
        <source>steady</source>
        <translation>稳定</translation>
    </message>
    <message>
        <source>still settling</source>
        <translation>仍在变化</translation>
    </message>
    <message>
        <source>uneven</source>
        <translation>不均匀</translation>
    </message>
    <message>
        <source>%1 %2 K</source>
        <translation>%1 %2 K</translation>
    </message>
    <message>
        <source>%1 %2 K/h</source>
        <translation>%1 %2 K/h</translation>
    </message>
    <message>
        <source>Not connected</source>
        <translation>未连接</translation>
    </message>
    <message>
        <source>Drawing</source>
        <translation>示意图</translation>
    </message>
    <message>
        <source>Registers</source>
        <translation>寄存器</translation>
    </message>
    <message>
        <source>Choose a profile</source>
        <translation>选择配置文件</translation>
    </message>
    <message>
        <source>Connection profile</source>
        <translation>连接配置文件</translation>
    </message>
    <message>
        <source>Sensors</source>
        <translation>传感器</translation>
    </message>
    <message>
        <source>value, age, noise</source>
        <translation>数值、时效、噪声</translation>
    </message>
    <message>
        <source>Sensor</source>
        <translation>传感器</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>数值</translation>
    </message>
    <message>
        <source>Age, noise</source>
        <translation>时效、噪声</translation>
    </message>
    <message>
        <source>%1 °C</source>
        <translation>%1 °C</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>  ±%1 K</source>
        <translation>  ±%1 K</translation>
    </message>
    <message>
        <source>Import</source>
        <translation>导入</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>添加</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>删除</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>保存</translation>
    </message>
    <message>
        <source>Registers from a CSV list or a map file</source>
        <translation>从 CSV 列表或映射文件导入寄存器</translation>
    </message>
    <message>
        <source>A register more</source>
        <translation>增加一个寄存器</translation>
    </message>
    <message>
        <source>Take the selected register out</source>
        <translation>删除所选寄存器</translation>
    </message>
    <message>
        <source>Save the map and use it</source>
        <translation>保存映射并使用</translation>
    </message>
    <message>
        <source>Start the virtual machine</source>
        <translation>启动虚拟机床</translation>
    </message>
    <message>
        <source>The machine of this job is a virtual one. It starts anew, cold; its tables are in this job.</source>
        <translation>此作业的机床是虚拟机床。它将重新冷态启动；其补偿表保存在本作业中。</translation>
    </message>
    <message>
        <source>This job has written version %1. Starting again measures anew, with the compensation off; what the machine holds stays until you write another table.</source>
        <translation>此作业已写入版本 %1。重新开始将在补偿断开的状态下重新测量；机床中的补偿表在写入另一补偿表之前保持不变。</translation>
    </message>
    <message>
        <source>Looks at the machine again and goes on to the calibration. Nothing is written and nothing is lost: what was measured stays in the job, and the machine keeps its table.</source>
        <translation>再次检查机床并继续标定。不写入任何内容，也不丢失任何内容：测量结果保留在作业中，机床保留其补偿表。</translation>
    </message>
    <message>
        <source>As of %1</source>
        <translation>截至 %1</translation>
    </message>
    <message>
        <source>The machine does not hold version %1, which this job has written: bring it back in Upload, or start again.</source>
        <translation>机床中不再有本作业写入的版本 %1：请在“上传”步骤中恢复，或重新开始。</translation>
    </message>
    <message>
        <source>The machine of this job is a virtual one: start it, or connect to another.</source>
        <translation>本作业的机床是虚拟机床：请启动它，或连接其他机床。</translation>
    </message>
    <message>
        <source>Opens Upload, which compares the table with what the machine holds and asks before it writes.</source>
        <translation>打开“上传”页，与机床中的补偿表比较，写入前会询问。</translation>
    </message>
    <message>
        <source>The machine compensates with version %1 of this job: go on in the list on the left. Switch the compensation off only to measure anew.</source>
        <translation>机床正在使用本作业的版本 %1 进行补偿：请在左侧列表中继续。仅在重新测量时才断开补偿。</translation>
    </message>
    <message>
        <source>Bring the table back</source>
        <translation>恢复补偿表</translation>
    </message>
    <message>
        <source>Spread at the start</source>
        <translation>开始时温差</translation>
    </message>
    <message>
        <source>now %1 K</source>
        <translation>现在 %1 K</translation>
    </message>
    <message>
        <source>Warmest less coldest of the sensors that live, each by the mean of its readings, when the commissioning began. The report says the same.</source>
        <translation>调试开始时正常传感器中最热与最冷之差，各取其读数的平均值。报告中的数值相同。</translation>
    </message>
    <message>
        <source>Warmest less coldest of the sensors that live, each by the mean of its last readings. It forbids nothing: a sensor by a motor that always holds is always warmer. What counts is that nothing changes any more (%1 K/h) when the run begins.</source>
        <translation>正常传感器中最热与最冷之差，各取最近读数的平均值。它不禁止任何操作：始终通电的电机旁的传感器总是较热。重要的是运行开始时不再变化（%1 K/h）。</translation>
    </message>
    <message>
        <source>This control has no link: connect to the devices, and answer what is asked about the control.</source>
        <translation>该控制器没有通信连接：请连接各设备，并回答有关控制器的询问。</translation>
    </message>
    <message>
        <source>Devices that answer</source>
        <translation>有应答的设备</translation>
    </message>
    <message>
        <source>Devices</source>
        <translation>设备</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>设备</translation>
    </message>
    <message>
        <source>From the request to the last answer</source>
        <translation>从询问到最近一次应答的时间</translation>
    </message>
    <message>
        <source>Age</source>
        <translation>时效</translation>
    </message>
    <message>
        <source>Since the last answer</source>
        <translation>距最近一次应答的时间</translation>
    </message>
    <message>
        <source>Missed</source>
        <translation>未应答</translation>
    </message>
    <message>
        <source>Requests without an answer since the connection was made</source>
        <translation>连接以来未应答的询问次数</translation>
    </message>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
    <message>
        <source>does not answer</source>
        <translation>无应答</translation>
    </message>
    <message>
        <source>answers</source>
        <translation>有应答</translation>
    </message>
    <message>
        <source>not asked yet</source>
        <translation>尚未询问</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>Add devices and cameras, test each, and say which signal is which; then save.</source>
        <translation>添加设备和相机，逐一测试，指定各信号的来源，然后保存。</translation>
    </message>
    <message>
        <source>Save and use</source>
        <translation>保存并使用</translation>
    </message>
    <message>
        <source>First mend what is named above.</source>
        <translation>请先改正上面指出的问题。</translation>
    </message>
    <message>
        <source>Saves the profile and uses it in this job</source>
        <translation>保存配置文件并用于本作业</translation>
    </message>
    <message>
        <source>Open profile</source>
        <translation>打开配置文件</translation>
    </message>
    <message>
        <source>Save as</source>
        <translation>另存为</translation>
    </message>
    <message>
        <source>Back to the machine</source>
        <translation>返回机床</translation>
    </message>
    <message>
        <source>Set up</source>
        <translation>设置</translation>
    </message>
    <message>
        <source>Devices, cameras and signals of this profile, or of a new one</source>
        <translation>此配置文件或新配置文件的设备、相机和信号</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::MachineStart</name>
    <message>
        <source>Start</source>
        <translation>开始</translation>
    </message>
    <message>
        <source>Recent jobs</source>
        <translation>最近的作业</translation>
    </message>
    <message>
        <source>New job</source>
        <translation>新作业</translation>
    </message>
    <message>
        <source>Open job</source>
        <translation>打开作业</translation>
    </message>
    <message>
        <source>Open the sample job</source>
        <translation>打开示例作业</translation>
    </message>
    <message>
        <source>Connect to the virtual machine</source>
        <translation>连接虚拟机床</translation>
    </message>
    <message>
        <source>One file holds the whole commissioning: measurements, model, tables, report.</source>
        <translation>一个文件包含整个调试过程：测量、模型、补偿表、报告。</translation>
    </message>
    <message>
        <source>Go on where the job stopped; also after a crash.</source>
        <translation>从作业中断处继续；程序崩溃后也可以。</translation>
    </message>
    <message>
        <source>A finished commissioning to look around in. Nothing needs to be connected.</source>
        <translation>一次已完成的调试，可供浏览，无需连接任何设备。</translation>
    </message>
    <message>
        <source>A five-axis machine in software, with controller and cameras, to try everything without risk.</source>
        <translation>软件模拟的五轴机床，带控制器和相机，可无风险地试用全部功能。</translation>
    </message>
    <message>
        <source>The way through</source>
        <translation>流程</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>机床</translation>
    </message>
    <message>
        <source>connect, see that all sensors live and the machine is cold</source>
        <translation>连接，确认所有传感器正常且机床处于冷态</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>标定</translation>
    </message>
    <message>
        <source>teach the camera what a micrometre is</source>
        <translation>让相机得知一微米有多大</translation>
    </message>
    <message>
        <source>Warm-up</source>
        <translation>暖机</translation>
    </message>
    <message>
        <source>record temperatures and errors while the machine warms</source>
        <translation>在机床升温过程中记录温度和误差</translation>
    </message>
    <message>
        <source>Sensors</source>
        <translation>传感器</translation>
    </message>
    <message>
        <source>keep the few that carry the error</source>
        <translation>保留少数能反映误差的传感器</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>拟合</translation>
    </message>
    <message>
        <source>make the model and judge it on what it has not seen</source>
        <translation>建立模型，用其未见过的数据评定</translation>
    </message>
    <message>
        <source>Physics</source>
        <translation>物理分析</translation>
    </message>
    <message>
        <source>find what the simulation lacks</source>
        <translation>找出仿真缺少的内容</translation>
    </message>
    <message>
        <source>Upload</source>
        <translation>上传</translation>
    </message>
    <message>
        <source>write the table as one transaction, old one saved</source>
        <translation>将补偿表作为一个事务写入，并保存旧表</translation>
    </message>
    <message>
        <source>Verify</source>
        <translation>验证</translation>
    </message>
    <message>
        <source>prove on the machine that the error is gone</source>
        <translation>在机床上证明误差已消除</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>报告</translation>
    </message>
    <message>
        <source>hand it over, every figure traceable</source>
        <translation>交付报告，每个数值均可追溯</translation>
    </message>
    <message>
        <source>No jobs yet. Jobs that you make or open are listed here.</source>
        <translation>尚无作业。新建或打开的作业将列在这里。</translation>
    </message>
    <message>
        <source>Use my own recording</source>
        <translation>使用我自己的记录</translation>
    </message>
    <message>
        <source>A logger&apos;s table of temperatures and errors, from any machine. Nothing needs to be connected.</source>
        <translation>记录仪的温度和误差表，来自任何机床。无需连接任何设备。</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::MainWindow</name>
    <message>
        <source>%1 (Ctrl+Enter)</source>
        <translation>%1（Ctrl+Enter）</translation>
    </message>
    <message>
        <source>Action</source>
        <translation>操作</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>步骤</translation>
    </message>
    <message>
        <source>Show what happened</source>
        <translation>显示事件记录</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>窗口</translation>
    </message>
    <message>
        <source>Switch between light and dark</source>
        <translation>切换浅色与深色</translation>
    </message>
    <message>
        <source>Change language</source>
        <translation>切换语言</translation>
    </message>
    <message>
        <source>Help for this step</source>
        <translation>本步骤帮助</translation>
    </message>
    <message>
        <source>Quit</source>
        <translation>退出</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>返回</translation>
    </message>
    <message>
        <source>To the step before (Alt+Left). Nothing is lost by going back.</source>
        <translation>返回上一步（Alt+Left）。返回不会丢失任何内容。</translation>
    </message>
    <message>
        <source>All keys</source>
        <translation>全部快捷键</translation>
    </message>
    <message>
        <source>About Zerodrift, licences</source>
        <translation>关于 Zerodrift、许可证</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::MatrixView</name>
    <message>
        <source>Correlation matrix</source>
        <translation>相关矩阵</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::Page</name>
    <message>
        <source>Wait until the work is done, or cancel it.</source>
        <translation>请等待工作完成，或将其取消。</translation>
    </message>
    <message>
        <source>Not yet: an earlier step comes first.</source>
        <translation>尚不可用：需先完成前面的步骤。</translation>
    </message>
    <message>
        <source>Not needed in this job: go on.</source>
        <translation>本作业不需要此步骤：请继续。</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>继续</translation>
    </message>
    <message>
        <source>Not needed</source>
        <translation>不需要</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::PhysicsPage</name>
    <message>
        <source>Physics</source>
        <translation>物理分析</translation>
    </message>
    <message>
        <source>The run is simulated from the machine&apos;s description. Let the program find what the simulation lacks.</source>
        <translation>已按机床描述对该运行进行仿真。由程序找出仿真缺少的内容。</translation>
    </message>
    <message>
        <source>Map, curves and figures hold what was adopted. Go on, or take it out again.</source>
        <translation>图、曲线和数值已包含所采纳的效应。可继续，或撤销采纳。</translation>
    </message>
    <message>
        <source>Something is missing in the simulation. Judge the explanations; adopt what convinces.</source>
        <translation>仿真缺少某些内容。请评判各项解释，采纳令人信服的解释。</translation>
    </message>
    <message>
        <source>Map, curves and figures hold what was adopted; the rest no known effect explains.</source>
        <translation>图、曲线和数值已包含所采纳的效应；其余部分没有已知效应可以解释。</translation>
    </message>
    <message>
        <source>Something is missing that no known effect explains. It is shown, not guessed.</source>
        <translation>存在已知效应无法解释的缺失。程序如实显示，不作猜测。</translation>
    </message>
    <message>
        <source>Find what is missing</source>
        <translation>查找缺失</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>继续</translation>
    </message>
    <message>
        <source>Open the seal</source>
        <translation>开启封条</translation>
    </message>
    <message>
        <source>The seal is opened when the answer is given.</source>
        <translation>给出答案后开启封条。</translation>
    </message>
    <message>
        <source>The seal is open.</source>
        <translation>封条已开启。</translation>
    </message>
    <message>
        <source>Blind trial</source>
        <translation>盲测</translation>
    </message>
    <message>
        <source>A blind trial is running.</source>
        <translation>盲测正在进行。</translation>
    </message>
    <message>
        <source>Open the seal of this trial first.</source>
        <translation>请先开启本次盲测的封条。</translation>
    </message>
    <message>
        <source>The virtual machine hides an effect; the program has to find it</source>
        <translation>虚拟机床隐藏一种效应，由程序找出</translation>
    </message>
    <message>
        <source>Find sensor region</source>
        <translation>查找传感器区域</translation>
    </message>
    <message>
        <source>Where on the component a sensor follows the deformation best</source>
        <translation>部件上哪个位置的传感器与变形的相关性最好</translation>
    </message>
    <message>
        <source>Search again</source>
        <translation>重新查找</translation>
    </message>
    <message>
        <source>down to noise</source>
        <translation>降至噪声水平</translation>
    </message>
    <message>
        <source>something missing</source>
        <translation>存在缺失</translation>
    </message>
    <message>
        <source>With what was adopted.</source>
        <translation>已计入所采纳的效应。</translation>
    </message>
    <message>
        <source>Noise of the sensors</source>
        <translation>传感器噪声</translation>
    </message>
    <message>
        <source>Missing heat</source>
        <translation>缺失的热量</translation>
    </message>
    <message>
        <source>explained by what was adopted</source>
        <translation>已由所采纳的效应解释</translation>
    </message>
    <message>
        <source>On unseen data</source>
        <translation>未参与拟合的数据</translation>
    </message>
    <message numerus="yes">
        <source>with %n adopted</source>
        <translation>
            <numerusform>已采纳 %n 项</numerusform>
        </translation>
    </message>
    <message>
        <source>none adopted</source>
        <translation>未采纳任何效应</translation>
    </message>
    <message>
        <source>The same difference on data that was not used for the search.</source>
        <translation>在未用于查找的数据上的同一差值。</translation>
    </message>
    <message>
        <source>Nothing to compare yet</source>
        <translation>尚无可比较的内容</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>位置</translation>
    </message>
    <message>
        <source>Channels</source>
        <translation>通道</translation>
    </message>
    <message>
        <source>What is left</source>
        <translation>剩余部分</translation>
    </message>
    <message>
        <source>Recorded minus simulated</source>
        <translation>记录减去仿真</translation>
    </message>
    <message>
        <source>Simulation and recording</source>
        <translation>仿真与记录</translation>
    </message>
    <message>
        <source>Drawn when the search is done</source>
        <translation>查找完成后绘制</translation>
    </message>
    <message>
        <source>agrees</source>
        <translation>一致</translation>
    </message>
    <message>
        <source>differs</source>
        <translation>不一致</translation>
    </message>
    <message>
        <source>Channel</source>
        <translation>通道</translation>
    </message>
    <message>
        <source>rms</source>
        <translation>rms</translation>
    </message>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
    <message>
        <source>Recorded</source>
        <translation>记录</translation>
    </message>
    <message>
        <source>Simulated</source>
        <translation>仿真</translation>
    </message>
    <message>
        <source>With effects</source>
        <translation>计入效应</translation>
    </message>
    <message>
        <source>recorded</source>
        <translation>记录</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>仿真</translation>
    </message>
    <message>
        <source>adopted</source>
        <translation>已采纳</translation>
    </message>
    <message>
        <source>difference / %1</source>
        <translation>差值 / %1</translation>
    </message>
    <message>
        <source>Recorded - simulated</source>
        <translation>记录 - 仿真</translation>
    </message>
    <message>
        <source>Recorded - refined</source>
        <translation>记录 - 改进模型</translation>
    </message>
    <message>
        <source>Explanations</source>
        <translation>解释</translation>
    </message>
    <message>
        <source>ranked by evidence</source>
        <translation>按证据排序</translation>
    </message>
    <message>
        <source>Not searched yet.</source>
        <translation>尚未查找。</translation>
    </message>
    <message>
        <source>Shortest run that decides</source>
        <translation>可作判定的最短运行</translation>
    </message>
    <message>
        <source>Put it into the plan</source>
        <translation>加入计划</translation>
    </message>
    <message>
        <source>The virtual machine hides one effect and seals its name. Watch the run, see what the search answers, then open the seal. Start with Blind trial above.</source>
        <translation>虚拟机床隐藏一种效应并封存其名称。观看运行，查看程序给出的答案，然后开启封条。由上方的“盲测”开始。</translation>
    </message>
    <message>
        <source>%1 of %2 hidden effects named correctly.</source>
        <translation>%2 个隐藏效应中正确识别 %1 个。</translation>
    </message>
    <message>
        <source>Hidden</source>
        <translation>隐藏</translation>
    </message>
    <message>
        <source>Answer</source>
        <translation>答案</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>结果</translation>
    </message>
    <message>
        <source>Improved</source>
        <translation>改善</translation>
    </message>
    <message>
        <source>right</source>
        <translation>正确</translation>
    </message>
    <message>
        <source>wrong</source>
        <translation>错误</translation>
    </message>
    <message>
        <source>to come</source>
        <translation>待定</translation>
    </message>
    <message>
        <source>1. Sealed: %1</source>
        <translation>1. 已封存：%1</translation>
    </message>
    <message>
        <source>2. Run watched: %1 %</source>
        <translation>2. 已观看运行：%1 %</translation>
    </message>
    <message>
        <source>3. Answer: %1</source>
        <translation>3. 答案：%1</translation>
    </message>
    <message>
        <source>searching</source>
        <translation>正在查找</translation>
    </message>
    <message>
        <source>4. Seal opened: %1 was hidden. The answer is %2; %3.</source>
        <translation>4. 封条已开启：隐藏的是“%1”。答案%2；%3。</translation>
    </message>
    <message>
        <source>the promise was kept</source>
        <translation>承诺得到遵守</translation>
    </message>
    <message>
        <source>the promise was broken</source>
        <translation>承诺被破坏</translation>
    </message>
    <message>
        <source>4. Seal: %1</source>
        <translation>4. 封条：%1</translation>
    </message>
    <message>
        <source>press Open the seal</source>
        <translation>请按“开启封条”</translation>
    </message>
    <message>
        <source>%1 simulated</source>
        <translation>%1 仿真</translation>
    </message>
    <message>
        <source>%1 with the answer</source>
        <translation>%1 按答案</translation>
    </message>
    <message>
        <source>with the answer</source>
        <translation>按答案</translation>
    </message>
    <message>
        <source>A part is explained, at the right. The rest no known effect explains: it is shown, not guessed.</source>
        <translation>一部分已得到解释，见右侧。其余部分没有已知效应可以解释：程序如实显示，不作猜测。</translation>
    </message>
    <message>
        <source>Within the tolerances of its description the simulation agrees with the recording. Nothing needs to be added.</source>
        <translation>在机床描述的容差范围内，仿真与记录一致。无需补充。</translation>
    </message>
    <message>
        <source>within its tolerances</source>
        <translation>在其容差范围内</translation>
    </message>
    <message>
        <source>As the machine is described: with every number at its middle.</source>
        <translation>按机床描述：各数值取标称值。</translation>
    </message>
    <message>
        <source>Simulation error, all sensors</source>
        <translation>仿真误差，全部传感器</translation>
    </message>
    <message>
        <source>Recorded less simulated, rms over all temperatures; a card tells of one channel.</source>
        <translation>记录值减仿真值，对所有温度取均方根；每张卡片只针对一个通道。</translation>
    </message>
    <message>
        <source>Say what the machine is: then its heat is simulated and compared.</source>
        <translation>说明机床的构成：然后对其热行为进行仿真并比较。</translation>
    </message>
    <message>
        <source>Open machine.json</source>
        <translation>打开 machine.json</translation>
    </message>
    <message>
        <source>Use a lump for each sensor</source>
        <translation>每个传感器用一个集总体</translation>
    </message>
    <message>
        <source>A start without a drawing: each sensor is a body of its own, its sizes are found</source>
        <translation>没有图纸时的起点：每个传感器自成一体，其大小由程序求得</translation>
    </message>
    <message>
        <source>The machine is not described yet</source>
        <translation>机床尚未描述</translation>
    </message>
    <message>
        <source>The description has no rod: see the channels.</source>
        <translation>描述中没有杆件：请看通道。</translation>
    </message>
    <message>
        <source>Describe the machine</source>
        <translation>描述机床</translation>
    </message>
    <message>
        <source>Edit description</source>
        <translation>编辑描述</translation>
    </message>
    <message>
        <source>Simulated is %1. It is changed here, or a machine.json takes its place</source>
        <translation>当前仿真依据：%1。可在此修改，或用 machine.json 替换</translation>
    </message>
    <message>
        <source>Enter its parts, heat sources and where each sensor sits; typical values are offered. Or open a machine.json. Without a drawing begin with a lump for each sensor.</source>
        <translation>请填写部件、热源以及各传感器的位置；会提供典型值。也可打开 machine.json。没有图纸时，先为每个传感器用一个集总体。</translation>
    </message>
    <message>
        <source>A form for parts, sizes, heat sources and sensors, drawn as they are entered</source>
        <translation>填写部件、尺寸、热源和传感器的表单，边填边画图</translation>
    </message>
    <message>
        <source>Compares the recording with the described machine and seeks effects that explain the difference</source>
        <translation>把记录与所描述的机床比较，寻找能解释差异的效应</translation>
    </message>
    <message>
        <source>A description that was made before</source>
        <translation>以前做好的描述</translation>
    </message>
    <message>
        <source>Seeks the effects anew, with the recordings and the description as they are now</source>
        <translation>按现在的记录和描述重新寻找效应</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::PlanTimeline</name>
    <message>
        <source>Plan: steps over time</source>
        <translation>计划：各步骤随时间的安排</translation>
    </message>
    <message>
        <source>%1 rpm</source>
        <translation>%1 r/min</translation>
    </message>
    <message>
        <source>rest</source>
        <translation>静止</translation>
    </message>
    <message>
        <source>axes run</source>
        <translation>各轴运动</translation>
    </message>
    <message>
        <source>axes stand</source>
        <translation>各轴静止</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::PlotWidget</name>
    <message>
        <source>Fit to the data</source>
        <translation>适应数据范围</translation>
    </message>
    <message>
        <source>Add a note here</source>
        <translation>在此添加备注</translation>
    </message>
    <message>
        <source>Save picture (PNG)</source>
        <translation>保存图片（PNG）</translation>
    </message>
    <message>
        <source>Save drawing (SVG)</source>
        <translation>保存矢量图（SVG）</translation>
    </message>
    <message>
        <source>Save visible values (CSV)</source>
        <translation>保存可见数值（CSV）</translation>
    </message>
    <message>
        <source>Copy picture</source>
        <translation>复制图片</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>保存</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ProblemBanner</name>
    <message>
        <source>Dismiss</source>
        <translation>关闭提示</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ProgressStrip</name>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>%1 left</source>
        <translation>剩余 %1</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::RecordingList</name>
    <message>
        <source>training</source>
        <translation>训练</translation>
    </message>
    <message>
        <source>another day</source>
        <translation>另一天</translation>
    </message>
    <message>
        <source>cooling</source>
        <translation>冷却</translation>
    </message>
    <message>
        <source>Recordings</source>
        <translation>记录</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>Serves as</source>
        <translation>用途</translation>
    </message>
    <message>
        <source>Name of the recording</source>
        <translation>记录名称</translation>
    </message>
    <message>
        <source>What the recording serves as</source>
        <translation>记录的用途</translation>
    </message>
    <message>
        <source>Training: fitted too. Another day: the fit is tested on it. Cooling: fitted too, and it shows how the heat goes. The physics explains all of them together.</source>
        <translation>训练：参与拟合。另一天：用于检验拟合。冷却：参与拟合，并显示热量如何散去。物理分析对全部记录一并解释。</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Takes the recording out of the list. Undo brings it back.</source>
        <translation>将该记录移出列表；撤销可恢复。</translation>
    </message>
    <message>
        <source>first run</source>
        <translation>首次运行</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::RegisterTable</name>
    <message>
        <source>Name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>地址</translation>
    </message>
    <message>
        <source>Function</source>
        <translation>功能</translation>
    </message>
    <message>
        <source>Type</source>
        <translation>类型</translation>
    </message>
    <message>
        <source>Count</source>
        <translation>数量</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>比例</translation>
    </message>
    <message>
        <source>Order</source>
        <translation>字节顺序</translation>
    </message>
    <message>
        <source>Value now</source>
        <translation>当前值</translation>
    </message>
    <message>
        <source>Meaning</source>
        <translation>含义</translation>
    </message>
    <message>
        <source>ABCD: high word and high byte first</source>
        <translation>ABCD：高位字、高位字节在前</translation>
    </message>
    <message>
        <source>Registers</source>
        <translation>寄存器</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ReportPage</name>
    <message>
        <source>Report</source>
        <translation>报告</translation>
    </message>
    <message>
        <source>Saved: %1</source>
        <translation>已保存：%1</translation>
    </message>
    <message>
        <source>Look at the doubtful figures first, fill in the head, then save.</source>
        <translation>先查看可疑数值，填写报告抬头，然后保存。</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>保存报告</translation>
    </message>
    <message>
        <source>Technical bundle</source>
        <translation>技术数据包</translation>
    </message>
    <message>
        <source>Nothing to report yet</source>
        <translation>尚无可报告的内容</translation>
    </message>
    <message>
        <source>Head of the report</source>
        <translation>报告抬头</translation>
    </message>
    <message>
        <source>Customer</source>
        <translation>客户</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>机床</translation>
    </message>
    <message>
        <source>Serial</source>
        <translation>序列号</translation>
    </message>
    <message>
        <source>Engineer</source>
        <translation>工程师</translation>
    </message>
    <message>
        <source>Standards</source>
        <translation>标准</translation>
    </message>
    <message>
        <source>those that were followed, if any</source>
        <translation>所遵循的标准（如有）</translation>
    </message>
    <message>
        <source>For example ISO 230-3:2020. Only what was run by the standard may be named here.</source>
        <translation>例如 ISO 230-3:2020。此处只能填写实际按标准进行的内容。</translation>
    </message>
    <message>
        <source>Content</source>
        <translation>内容</translation>
    </message>
    <message>
        <source>Doubtful</source>
        <translation>可疑</translation>
    </message>
    <message>
        <source>Doubtful (%1)</source>
        <translation>可疑（%1）</translation>
    </message>
    <message>
        <source>Sections</source>
        <translation>章节</translation>
    </message>
    <message>
        <source>Click to look into it</source>
        <translation>点击查看</translation>
    </message>
    <message>
        <source>No figure of this job looks doubtful.</source>
        <translation>本作业没有可疑数值。</translation>
    </message>
    <message>
        <source>Language of the report</source>
        <translation>报告语言</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>预览</translation>
    </message>
    <message>
        <source>1 page</source>
        <translation>1 页</translation>
    </message>
    <message>
        <source>%1 pages</source>
        <translation>%1 页</translation>
    </message>
    <message>
        <source>The preview is being made.</source>
        <translation>正在生成预览。</translation>
    </message>
    <message>
        <source>Page %1</source>
        <translation>第 %1 页</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>语言</translation>
    </message>
    <message>
        <source>Company</source>
        <translation>公司</translation>
    </message>
    <message>
        <source>Logo and address of your company, at the head of every report from this computer</source>
        <translation>贵公司的徽标和地址，显示在本计算机生成的每份报告的抬头</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>打开</translation>
    </message>
    <message>
        <source>Opens what was saved last</source>
        <translation>打开最近保存的文件</translation>
    </message>
    <message>
        <source>Show in folder</source>
        <translation>打开所在文件夹</translation>
    </message>
    <message>
        <source>Print</source>
        <translation>打印</translation>
    </message>
    <message>
        <source>For support: job, log, pictures and figures in one zip beside the job, without passwords</source>
        <translation>供技术支持使用：作业、日志、截图和数据打包为作业旁的一个 zip 文件，不含密码</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1（%2）</translation>
    </message>
    <message>
        <source>Writes the pages at the left into a file of the chosen format</source>
        <translation>把左侧各页按所选格式写入文件</translation>
    </message>
    <message>
        <source>Opens the folder of what was saved last</source>
        <translation>打开上次保存的文件所在文件夹</translation>
    </message>
    <message>
        <source>The pages at the left, on a printer of this computer</source>
        <translation>在本计算机的打印机上打印左侧各页</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::RigSetup</name>
    <message>
        <source>not saved yet</source>
        <translation>尚未保存</translation>
    </message>
    <message>
        <source>%1, changed</source>
        <translation>%1，已修改</translation>
    </message>
    <message>
        <source>Found</source>
        <translation>已找到</translation>
    </message>
    <message>
        <source>Detail</source>
        <translation>详情</translation>
    </message>
    <message>
        <source>Warm one sensor with your hand: the right row must rise.</source>
        <translation>用手加热一个传感器：对应行的数值必须上升。</translation>
    </message>
    <message numerus="yes">
        <source>%n assigned</source>
        <translation>
            <numerusform>已指定 %n 个</numerusform>
        </translation>
    </message>
    <message>
        <source>Rig</source>
        <translation>测量装置</translation>
    </message>
    <message>
        <source>Devices and cameras</source>
        <translation>设备和相机</translation>
    </message>
    <message>
        <source>Signals</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>撤消</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>重做</translation>
    </message>
    <message>
        <source>Find ports</source>
        <translation>查找串口</translation>
    </message>
    <message>
        <source>Find units</source>
        <translation>查找单元</translation>
    </message>
    <message>
        <source>Find in the network</source>
        <translation>在网络中查找</translation>
    </message>
    <message>
        <source>Find cameras</source>
        <translation>查找相机</translation>
    </message>
    <message>
        <source>Serial ports of this computer</source>
        <translation>本计算机的串口</translation>
    </message>
    <message>
        <source>Asks each unit number from 1 to 247 on this port. It takes up to a minute.</source>
        <translation>在此串口上逐一询问单元号 1 至 247，最多需要一分钟。</translation>
    </message>
    <message>
        <source>Tries the ports 502 and 5000 at the addresses of this computer&apos;s own networks</source>
        <translation>在本计算机所在网络的各地址上尝试端口 502 和 5000</translation>
    </message>
    <message>
        <source>GigE Vision, USB3 Vision and devices of this computer</source>
        <translation>GigE Vision、USB3 Vision 及本计算机的设备</translation>
    </message>
    <message>
        <source>Test</source>
        <translation>测试</translation>
    </message>
    <message>
        <source>Connects and reads once</source>
        <translation>连接并读取一次</translation>
    </message>
    <message>
        <source>Add its sensors</source>
        <translation>添加其传感器</translation>
    </message>
    <message>
        <source>A temperature sensor for each channel that none reads yet</source>
        <translation>为每个尚未使用的通道添加一个温度传感器</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>预览</translation>
    </message>
    <message>
        <source>No picture yet</source>
        <translation>尚无图像</translation>
    </message>
    <message>
        <source>Brightness of the pixels</source>
        <translation>像素亮度</translation>
    </message>
    <message>
        <source>Dark at the left, bright at the right; the last bar is saturated pixels</source>
        <translation>左暗右亮；最后一条为饱和像素</translation>
    </message>
    <message>
        <source>Add sensor</source>
        <translation>添加传感器</translation>
    </message>
    <message>
        <source>Remove sensor</source>
        <translation>移除传感器</translation>
    </message>
    <message>
        <source>Read live</source>
        <translation>实时读取</translation>
    </message>
    <message>
        <source>Connects to the devices and reads once a second</source>
        <translation>连接设备，每秒读取一次</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::RunView</name>
    <message>
        <source>Temperatures</source>
        <translation>温度</translation>
    </message>
    <message>
        <source>Errors</source>
        <translation>误差</translation>
    </message>
    <message>
        <source>Inputs</source>
        <translation>输入</translation>
    </message>
    <message>
        <source>speed in rpm</source>
        <translation>转速 r/min</translation>
    </message>
    <message numerus="yes">
        <source>%n channels</source>
        <translation>
            <numerusform>%n 个通道</numerusform>
        </translation>
    </message>
    <message>
        <source>10 min</source>
        <translation>10 min</translation>
    </message>
    <message>
        <source>1 h</source>
        <translation>1 h</translation>
    </message>
    <message>
        <source>All</source>
        <translation>全部</translation>
    </message>
    <message>
        <source>Channel</source>
        <translation>通道</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>数值</translation>
    </message>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
    <message>
        <source>No picture yet</source>
        <translation>尚无图像</translation>
    </message>
    <message>
        <source>Waiting for the first sample</source>
        <translation>等待第一次采样</translation>
    </message>
    <message>
        <source>Happened in this run</source>
        <translation>本次运行中发生</translation>
    </message>
    <message>
        <source>Everything is in order again.</source>
        <translation>已全部恢复正常。</translation>
    </message>
    <message>
        <source>In this run: %1</source>
        <translation>本次运行：%1</translation>
    </message>
    <message>
        <source>The controller has been silent since %1: the run waits, nothing is recorded. Finish keeps what there is.</source>
        <translation>控制器自 %1 起无应答：运行在等待，未记录数据。“结束”会保留已有数据。</translation>
    </message>
    <message>
        <source>The controller does not answer: it cannot be told to stop.</source>
        <translation>控制器无应答：无法令其停止。</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>已停住</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::SensorsPage</name>
    <message>
        <source>Sensors</source>
        <translation>传感器</translation>
    </message>
    <message>
        <source>Keep the few sensors that carry the error. Tick one in or out; its price shows at once.</source>
        <translation>保留少数能反映误差的传感器。勾选或取消后立即显示其代价。</translation>
    </message>
    <message>
        <source>Use these sensors</source>
        <translation>使用这些传感器</translation>
    </message>
    <message>
        <source>The figures of the last change are being computed.</source>
        <translation>正在计算上次更改后的数值。</translation>
    </message>
    <message>
        <source>Keep at least one sensor.</source>
        <translation>至少保留一个传感器。</translation>
    </message>
    <message>
        <source>Proposed choice</source>
        <translation>推荐选择</translation>
    </message>
    <message>
        <source>Sensors kept</source>
        <translation>保留的传感器</translation>
    </message>
    <message>
        <source>of %1</source>
        <translation>共 %1</translation>
    </message>
    <message>
        <source>Error on unseen</source>
        <translation>未见数据误差</translation>
    </message>
    <message>
        <source>Root mean square over stretches of the run that the model was not fitted to.</source>
        <translation>未参与模型拟合的运行数据段上的均方根。</translation>
    </message>
    <message>
        <source>Lost against all</source>
        <translation>与全部相比的损失</translation>
    </message>
    <message>
        <source>nothing lost</source>
        <translation>没有损失</translation>
    </message>
    <message>
        <source>Condition number</source>
        <translation>条件数</translation>
    </message>
    <message>
        <source>much alike</source>
        <translation>非常相似</translation>
    </message>
    <message>
        <source>computing</source>
        <translation>正在计算</translation>
    </message>
    <message>
        <source>No sensors to choose from yet</source>
        <translation>尚无可选的传感器</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>聚类</translation>
    </message>
    <message>
        <source>Series</source>
        <translation>时间序列</translation>
    </message>
    <message>
        <source>Correlation</source>
        <translation>相关性</translation>
    </message>
    <message>
        <source>Budget</source>
        <translation>传感器数量</translation>
    </message>
    <message>
        <source>auto (%1)</source>
        <translation>自动（%1）</translation>
    </message>
    <message>
        <source>with sign</source>
        <translation>带符号</translation>
    </message>
    <message>
        <source>absolute</source>
        <translation>绝对值</translation>
    </message>
    <message>
        <source>As published the correlations with X, Y and Z are added with their signs.
Opposite signs cancel: a sensor that drives X up and Z down may look useless.
The sum of absolute values does not have this fault.</source>
        <translation>按公开方法，与 X、Y、Z 的相关系数带符号相加。
符号相反时会相互抵消：使 X 增大、Z 减小的传感器可能显得无用。
绝对值之和没有这一缺陷。</translation>
    </message>
    <message>
        <source>Component %1</source>
        <translation>主成分 %1</translation>
    </message>
    <message>
        <source>Component %1 (%2 %)</source>
        <translation>主成分 %1（%2 %）</translation>
    </message>
    <message>
        <source>Cluster %1</source>
        <translation>聚类 %1</translation>
    </message>
    <message>
        <source>Sensors near each other warm alike. Filled: kept. Click a sensor to keep or leave it.</source>
        <translation>彼此靠近的传感器升温相似。实心：保留。点击传感器可保留或去除。</translation>
    </message>
    <message>
        <source>Temperatures by cluster, each scaled to its own spread. Thick: kept.</source>
        <translation>按聚类显示的温度，各自按其离散度缩放。粗线：保留。</translation>
    </message>
    <message>
        <source>Correlation of each sensor with the errors, and their sum.</source>
        <translation>各传感器与误差的相关系数及其总和。</translation>
    </message>
    <message>
        <source>Error on unseen stretches against the number of sensors: where the curve turns flat, more do not help.</source>
        <translation>未见数据段误差与传感器数量的关系：曲线变平后，增加传感器不再有益。</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>平均</translation>
    </message>
    <message>
        <source>number of sensors</source>
        <translation>传感器数量</translation>
    </message>
    <message>
        <source>error on unseen / µm</source>
        <translation>未见数据误差 / µm</translation>
    </message>
    <message>
        <source>The budget curve is being computed</source>
        <translation>正在计算数量曲线</translation>
    </message>
    <message>
        <source>Your choice</source>
        <translation>您的选择</translation>
    </message>
    <message>
        <source>limit</source>
        <translation>限值</translation>
    </message>
    <message>
        <source>Choice</source>
        <translation>选择</translation>
    </message>
    <message>
        <source>Sensor</source>
        <translation>传感器</translation>
    </message>
    <message>
        <source>Sum</source>
        <translation>总和</translation>
    </message>
    <message>
        <source>Largest in its cluster: thermally sensitive point</source>
        <translation>该聚类中最大：热敏感点</translation>
    </message>
    <message>
        <source>Lag</source>
        <translation>滞后</translation>
    </message>
    <message>
        <source>The error follows this sensor after so many minutes</source>
        <translation>误差滞后于该传感器的分钟数</translation>
    </message>
    <message>
        <source>Variance inflation: above 10 the sensor repeats others</source>
        <translation>方差膨胀因子：大于 10 时该传感器与其他传感器重复</translation>
    </message>
    <message>
        <source>Price</source>
        <translation>代价</translation>
    </message>
    <message>
        <source>Change of the error on unseen stretches when this tick is changed; plus: worse, minus: better</source>
        <translation>改变该勾选时未见数据段误差的变化；正：变差，负：改善</translation>
    </message>
    <message>
        <source>%1 min</source>
        <translation>%1 min</translation>
    </message>
    <message>
        <source>0.00 µm</source>
        <translation>0.00 µm</translation>
    </message>
    <message>
        <source>Keeping it or not makes no difference</source>
        <translation>保留与否没有差别</translation>
    </message>
    <message>
        <source>Without it the error grows by %1 µm: keep it</source>
        <translation>去掉它误差增大 %1 µm：应保留</translation>
    </message>
    <message>
        <source>Without it the error shrinks by %1 µm: leave it out</source>
        <translation>去掉它误差减小 %1 µm：应去除</translation>
    </message>
    <message>
        <source>With it the error shrinks by %1 µm: worth keeping</source>
        <translation>加入它误差减小 %1 µm：值得保留</translation>
    </message>
    <message>
        <source>With it the error grows by %1 µm: leave it out</source>
        <translation>加入它误差增大 %1 µm：应去除</translation>
    </message>
    <message>
        <source>Price: what a click on the tick does to the error on unseen stretches. Plus: it grows, leave the tick as it is. Minus (bold): it shrinks.</source>
        <translation>代价：点击勾选后未见数据段误差的变化。正：误差增大，保持勾选不变。负（粗体）：误差减小。</translation>
    </message>
    <message>
        <source>Of the fit on the kept sensors, its penalty included. Large: their coefficients disturb one another.</source>
        <translation>所选传感器上的拟合（含惩罚项）的条件数。过大：各系数相互干扰。</translation>
    </message>
    <message>
        <source>%1: %2.</source>
        <translation>%1：%2。</translation>
    </message>
    <message>
        <source>Correlation with the error in %1</source>
        <translation>与 %1 误差的相关性</translation>
    </message>
    <message>
        <source>Goes on: the model is fitted on the sensors that are ticked</source>
        <translation>继续：用勾选的传感器拟合模型</translation>
    </message>
    <message>
        <source>Ticks the sensors with the least error to expect again</source>
        <translation>重新勾选预期误差最小的传感器</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::SignCheck</name>
    <message>
        <source>%1 commanded %2, seen %3</source>
        <translation>%1 指令 %2，观测 %3</translation>
    </message>
    <message>
        <source>%1 not in view</source>
        <translation>%1 不在视场内</translation>
    </message>
    <message>
        <source>Sign check: %1. %2</source>
        <translation>符号检查：%1。%2</translation>
    </message>
    <message>
        <source>not in view</source>
        <translation>不在视场内</translation>
    </message>
    <message>
        <source>Not checked yet. Before the table is written each axis is moved by a few micrometres, watched by the camera: a wrong sign or axis stops everything.</source>
        <translation>尚未检查。写入补偿表之前，每轴移动几微米并由相机观测：符号或轴有误时立即停止。</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::SignalTable</name>
    <message>
        <source>Quantity</source>
        <translation>量</translation>
    </message>
    <message>
        <source>Label</source>
        <translation>标签</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>设备</translation>
    </message>
    <message>
        <source>Register, topic or item</source>
        <translation>寄存器、主题或数据项</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>单位</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>比例</translation>
    </message>
    <message>
        <source>Value now</source>
        <translation>当前值</translation>
    </message>
    <message>
        <source>Plausible?</source>
        <translation>是否可信</translation>
    </message>
    <message>
        <source>Factor from the register to the value. It holds for all values of this register in this device.</source>
        <translation>寄存器到数值的系数，对此设备该寄存器的所有数值有效。</translation>
    </message>
    <message>
        <source>Signals</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>to be mended</source>
        <translation>待改正</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::SignaturePad</name>
    <message>
        <source>Signature</source>
        <translation>签名</translation>
    </message>
    <message>
        <source>Sign here. Double click clears.</source>
        <translation>在此签名。双击清除。</translation>
    </message>
    <message>
        <source>Sign here</source>
        <translation>在此签名</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::StepButton</name>
    <message>
        <source>current page</source>
        <translation>当前页面</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::StepList</name>
    <message>
        <source>done</source>
        <translation>完成</translation>
    </message>
    <message>
        <source>running</source>
        <translation>进行中</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>失败</translation>
    </message>
    <message>
        <source>skipped</source>
        <translation>已跳过</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>等待</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::StepRail</name>
    <message>
        <source>No job open</source>
        <translation>未打开作业</translation>
    </message>
    <message>
        <source>Job: %1</source>
        <translation>作业：%1</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>浅色</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>深色</translation>
    </message>
    <message>
        <source>Switch to light colours</source>
        <translation>切换到浅色</translation>
    </message>
    <message>
        <source>Switch to dark colours</source>
        <translation>切换到深色</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>帮助</translation>
    </message>
    <message>
        <source>Help for this step (F1)</source>
        <translation>本步骤帮助（F1）</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>语言</translation>
    </message>
    <message>
        <source>Language: %1</source>
        <translation>语言：%1</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::UploadPage</name>
    <message>
        <source>Upload</source>
        <translation>上传</translation>
    </message>
    <message>
        <source>The table is being written. It becomes active as a whole or not at all.</source>
        <translation>正在写入补偿表。它将整体生效，或完全不生效。</translation>
    </message>
    <message>
        <source>Version %1 is active in %2. Now prove it.</source>
        <translation>版本 %1 已在 %2 中生效。接下来进行验证。</translation>
    </message>
    <message>
        <source>Compare the old table with the new one, let the camera check the sign, then write.</source>
        <translation>比较新旧补偿表，由相机检查符号，然后写入。</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>继续</translation>
    </message>
    <message>
        <source>Write to the machine</source>
        <translation>写入机床</translation>
    </message>
    <message>
        <source>The table is being written.</source>
        <translation>正在写入补偿表。</translation>
    </message>
    <message>
        <source>The compensation is ON. Tables may only be written while it is off.</source>
        <translation>补偿处于接通状态。只有断开时才能写入补偿表。</translation>
    </message>
    <message>
        <source>The largest change is above the machine&apos;s limit.</source>
        <translation>最大变化超过机床的限值。</translation>
    </message>
    <message>
        <source>The camera saw the test move in the wrong direction.</source>
        <translation>相机观测到测试移动的方向错误。</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>导出</translation>
    </message>
    <message>
        <source>Dry run</source>
        <translation>试运行</translation>
    </message>
    <message>
        <source>Check sign</source>
        <translation>检查符号</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>Version</source>
        <translation>版本</translation>
    </message>
    <message>
        <source>active</source>
        <translation>有效</translation>
    </message>
    <message>
        <source>to write</source>
        <translation>待写入</translation>
    </message>
    <message>
        <source>before: %1</source>
        <translation>之前：%1</translation>
    </message>
    <message>
        <source>in the machine: %1</source>
        <translation>机床中：%1</translation>
    </message>
    <message>
        <source>the machine is not read yet</source>
        <translation>尚未读取机床</translation>
    </message>
    <message>
        <source>Registers</source>
        <translation>寄存器</translation>
    </message>
    <message>
        <source>fits</source>
        <translation>容量足够</translation>
    </message>
    <message>
        <source>of %1</source>
        <translation>共 %1</translation>
    </message>
    <message>
        <source>Sign</source>
        <translation>符号</translation>
    </message>
    <message>
        <source>wrong</source>
        <translation>错误</translation>
    </message>
    <message>
        <source>right</source>
        <translation>正确</translation>
    </message>
    <message>
        <source>seen by the camera</source>
        <translation>由相机观测</translation>
    </message>
    <message>
        <source>not checked yet</source>
        <translation>尚未检查</translation>
    </message>
    <message>
        <source>Steepest term</source>
        <translation>最大系数</translation>
    </message>
    <message>
        <source>µm/K</source>
        <translation>µm/K</translation>
    </message>
    <message>
        <source>No table to write yet</source>
        <translation>尚无可写入的补偿表</translation>
    </message>
    <message>
        <source>Old and new compensation</source>
        <translation>新旧补偿</translation>
    </message>
    <message>
        <source>The controller takes %1.</source>
        <translation>控制器可接受%1。</translation>
    </message>
    <message>
        <source>Nothing is lost on the way.</source>
        <translation>转换中没有损失。</translation>
    </message>
    <message>
        <source>Lost: %1.</source>
        <translation>损失：%1。</translation>
    </message>
    <message>
        <source>Transaction</source>
        <translation>事务</translation>
    </message>
    <message>
        <source>Write</source>
        <translation>写入</translation>
    </message>
    <message>
        <source>Sign check</source>
        <translation>符号检查</translation>
    </message>
    <message>
        <source>Old</source>
        <translation>旧</translation>
    </message>
    <message>
        <source>New</source>
        <translation>新</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>变化</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>单位</translation>
    </message>
    <message>
        <source>old</source>
        <translation>旧</translation>
    </message>
    <message>
        <source>new</source>
        <translation>新</translation>
    </message>
    <message>
        <source>change</source>
        <translation>变化</translation>
    </message>
    <message>
        <source>limit</source>
        <translation>限值</translation>
    </message>
    <message>
        <source>ramp %1 %</source>
        <translation>渐变 %1 %</translation>
    </message>
    <message>
        <source>Written</source>
        <translation>写入时间</translation>
    </message>
    <message>
        <source>By</source>
        <translation>写入人</translation>
    </message>
    <message>
        <source>active: %1</source>
        <translation>有效：%1</translation>
    </message>
    <message>
        <source>Roll back to version %1</source>
        <translation>回滚到版本 %1</translation>
    </message>
    <message>
        <source>Roll back</source>
        <translation>回滚</translation>
    </message>
    <message>
        <source>Largest change now</source>
        <translation>此刻最大变化</translation>
    </message>
    <message>
        <source>Between the old and the new table at the temperatures of this moment: so far the axes would move. While the machine warms it grows; the curve shows it over the whole warm-up run.</source>
        <translation>在此刻的温度下新旧补偿表之差，即各轴将移动的量。机床升温时该值会增大；曲线显示整个暖机运行中的变化。</translation>
    </message>
    <message>
        <source>History, roll back</source>
        <translation>历史与回滚</translation>
    </message>
    <message>
        <source>How</source>
        <translation>来历</translation>
    </message>
    <message>
        <source>Nothing was written into this machine yet.</source>
        <translation>尚未向这台机床写入过任何内容。</translation>
    </message>
    <message>
        <source>Select the version to go back to.</source>
        <translation>请选择要回滚到的版本。</translation>
    </message>
    <message>
        <source>Writes version %1 (%2) again, as a new version. The difference is shown and you are asked.</source>
        <translation>将版本 %1（%2）作为新版本重新写入。先显示差异并询问。</translation>
    </message>
    <message>
        <source>Version %1 was active in %2 as this job left it, %3.</source>
        <translation>此作业最后记录时（%3），版本 %1 在 %2 中生效。</translation>
    </message>
    <message>
        <source>Version %1 is active in %2, and its verification run is done.</source>
        <translation>版本 %1 已在 %2 中生效，验证运行也已完成。</translation>
    </message>
    <message>
        <source>%1.</source>
        <comment>a whole sentence</comment>
        <translation>%1。</translation>
    </message>
    <message>
        <source>%1 holds no compensation any more. Write puts the last table back.</source>
        <translation>%1 中已没有补偿。“写入”将恢复最后一个补偿表。</translation>
    </message>
    <message>
        <source>Term of the error</source>
        <translation>误差项</translation>
    </message>
    <message>
        <source>What each term predicts of the error, actual less commanded, as in the report and in the file. The controller moves against it: the curve above is that compensation.</source>
        <translation>各项所预测的误差（实际减指令），与报告和文件中一致。控制器按相反方向移动：上方曲线即为该补偿。</translation>
    </message>
    <message>
        <source>Shows what is written and asks; the table before stays in the history</source>
        <translation>显示将写入的内容并询问；原来的表保留在历史记录中</translation>
    </message>
    <message>
        <source>The table as a file for a controller</source>
        <translation>供控制器使用的表文件</translation>
    </message>
    <message>
        <source>Everything but the write: reads, compares and says what would change</source>
        <translation>除写入外全部执行：读取、比较，并说明会改变什么</translation>
    </message>
    <message>
        <source>A small offset for a moment; the camera sees whether the machine moves the right way</source>
        <translation>短暂施加一个小偏置；相机观察机床是否朝正确方向移动</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::VerifyPage</name>
    <message>
        <source>Verify</source>
        <translation>验证</translation>
    </message>
    <message>
        <source>Run the machine with the compensation on and measure what is left.</source>
        <translation>在补偿接通的状态下运行机床，测量残余误差。</translation>
    </message>
    <message>
        <source>The compensation works while the camera watches. The measured curve must stay near zero.</source>
        <translation>补偿正在工作，相机同时观测。实测曲线应保持在零附近。</translation>
    </message>
    <message>
        <source>Paused. Resume when the machine may run again.</source>
        <translation>已暂停。机床可以再次运行时请继续。</translation>
    </message>
    <message>
        <source>Start verification</source>
        <translation>开始验证</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>暂停</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>继续运行</translation>
    </message>
    <message>
        <source>Apply correction</source>
        <translation>应用修正</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>继续</translation>
    </message>
    <message>
        <source>Abort</source>
        <translation>中止</translation>
    </message>
    <message>
        <source>Stops the machine and drops this verification. Asks first.</source>
        <translation>停止机床并放弃本次验证。会先询问。</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>结束</translation>
    </message>
    <message>
        <source>Ends the run here and keeps what was measured. Asks first.</source>
        <translation>在此结束运行并保留已测内容。会先询问。</translation>
    </message>
    <message>
        <source>Verify again</source>
        <translation>重新验证</translation>
    </message>
    <message>
        <source>Leave as it is</source>
        <translation>保持不变</translation>
    </message>
    <message>
        <source>Peak without</source>
        <translation>无补偿峰值</translation>
    </message>
    <message>
        <source>in %1</source>
        <translation>%1 轴</translation>
    </message>
    <message>
        <source>Largest error of the warm-up run, over the minutes that the verification lasted.</source>
        <translation>暖机运行在验证时长范围内的最大误差。</translation>
    </message>
    <message>
        <source>Peak with</source>
        <translation>有补偿峰值</translation>
    </message>
    <message>
        <source>in %1, %2</source>
        <translation>%1 轴，%2</translation>
    </message>
    <message>
        <source>rms with</source>
        <translation>有补偿 rms</translation>
    </message>
    <message>
        <source>Removed</source>
        <translation>消除</translation>
    </message>
    <message>
        <source>%1 worse</source>
        <translation>%1 变差</translation>
    </message>
    <message>
        <source>Fit promised</source>
        <translation>拟合的预期</translation>
    </message>
    <message>
        <source>Largest error that the fit left on stretches of the warm-up run it had not seen.</source>
        <translation>拟合在暖机运行未见数据段上残余的最大误差。</translation>
    </message>
    <message>
        <source>not reached</source>
        <translation>未达到</translation>
    </message>
    <message>
        <source>held</source>
        <translation>达到</translation>
    </message>
    <message>
        <source>Last good frame</source>
        <translation>上次有效图像</translation>
    </message>
    <message>
        <source>measuring</source>
        <translation>正在测量</translation>
    </message>
    <message>
        <source>Machine time since the camera last measured the error. Up to %1 it is as planned.</source>
        <translation>相机上次测得误差以来的机床时间。%1 以内属正常。</translation>
    </message>
    <message>
        <source>%1 became worse: up to %2 µm without, %3 µm with the compensation.</source>
        <translation>%1 变差：无补偿最大 %2 µm，有补偿最大 %3 µm。</translation>
    </message>
    <message>
        <source>At the end %1 is worse than without: %2 µm instead of %3 µm.</source>
        <translation>末段 %1 比无补偿时更差：%2 µm，而非 %3 µm。</translation>
    </message>
    <message>
        <source>The fit promised %1 µm, measured are %2 µm. The promise is of stretches of the warm-up run that were left out, as means of some minutes each; this run goes through other speeds in another order, and every single measurement counts with its noise.</source>
        <translation>拟合的预期为 %1 µm，实测为 %2 µm。预期针对暖机运行中留出的数据段，且为数分钟的平均值；本次运行以不同的次序经历其他转速，且每一次单独测量都带有噪声。</translation>
    </message>
    <message>
        <source>Nothing to verify yet</source>
        <translation>尚无可验证的内容</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>运行</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>实时</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>结果</translation>
    </message>
    <message>
        <source>Correction proposed</source>
        <translation>建议修正</translation>
    </message>
    <message>
        <source>Correction</source>
        <translation>修正</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Correction of the model</source>
        <translation>模型的修正</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>阈值</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>轴</translation>
    </message>
    <message>
        <source>The temperatures&apos; effect is multiplied by this</source>
        <translation>温度影响乘以该系数</translation>
    </message>
    <message>
        <source>Peak now</source>
        <translation>当前峰值</translation>
    </message>
    <message>
        <source>Then</source>
        <translation>修正后</translation>
    </message>
    <message>
        <source>Predicted with the correction</source>
        <translation>采用修正后的预测值</translation>
    </message>
    <message>
        <source>The correction is computed from the verification run when it is finished.</source>
        <translation>验证运行结束后计算修正。</translation>
    </message>
    <message>
        <source>With the correction the table is written anew, as a new version. The old one stays for rollback.</source>
        <translation>采用修正后，补偿表将作为新版本重新写入。旧版本保留，可供回滚。</translation>
    </message>
    <message>
        <source>A correction was proposed and left aside: the table stays as it is.</source>
        <translation>曾建议修正但未采用：补偿表保持不变。</translation>
    </message>
    <message>
        <source>All parts of the error are below the threshold. No correction is needed.</source>
        <translation>所有误差部分均低于阈值，无需修正。</translation>
    </message>
    <message>
        <source>Shown when the verification is finished</source>
        <translation>验证结束后显示</translation>
    </message>
    <message>
        <source>threshold</source>
        <translation>阈值</translation>
    </message>
    <message>
        <source>as measured</source>
        <translation>实测</translation>
    </message>
    <message>
        <source>with the correction</source>
        <translation>采用修正后</translation>
    </message>
    <message>
        <source>%1, measured</source>
        <translation>%1，实测</translation>
    </message>
    <message>
        <source>%1, with correction</source>
        <translation>%1，采用修正后</translation>
    </message>
    <message>
        <source>Share of the largest error that is gone, for each direction by itself; %1. Judged by the least of those whose error was above %2 µm before.</source>
        <translation>各方向最大误差中已消除的比例；%1。以补偿前误差大于 %2 µm 的方向中的最小值评定。</translation>
    </message>
    <message>
        <source>Removed in %1</source>
        <translation>%1 消除</translation>
    </message>
    <message>
        <source>Look at the proposed correction.</source>
        <translation>请查看建议的修正。</translation>
    </message>
    <message>
        <source>%1 is still above the limit of %2 µm.</source>
        <translation>%1 仍超过限值 %2 µm。</translation>
    </message>
    <message>
        <source>The proof is complete: every axis keeps its limit. Save the report next.</source>
        <translation>验证完成：各轴均在限值之内。下一步请保存报告。</translation>
    </message>
    <message>
        <source>Roll back to version %1</source>
        <translation>回滚到版本 %1</translation>
    </message>
    <message>
        <source>Opens the history in Upload with that version chosen; it asks before it writes.</source>
        <translation>在“上传”页打开历史并选中该版本；写入前会询问。</translation>
    </message>
    <message>
        <source>Largest error that this very run would have had without compensation: measured less applied.</source>
        <translation>本次运行若无补偿时的最大误差：测量值减去已施加的补偿。</translation>
    </message>
    <message>
        <source>%1 is worse than with version %2: %3 µm rms now; over this same run version %2 would have left %4 µm. Roll back to version %2?</source>
        <translation>%1 比版本 %2 更差：现在均方根为 %3 µm；在同一运行中，版本 %2 会剩余 %4 µm。是否回滚到版本 %2？</translation>
    </message>
    <message>
        <source>Without is this same run less what was applied: the same speeds and the same minutes.</source>
        <translation>“无补偿”即同一运行减去已施加的补偿：转速与时间完全相同。</translation>
    </message>
    <message>
        <source>Without is the warm-up run: other speeds, over the same minutes since the start of each run, as far as the shorter one goes.</source>
        <translation>“无补偿”为暖机运行：转速不同，各自从开始起取相同的时间，以较短的运行为准。</translation>
    </message>
    <message>
        <source>The proof is complete: every axis keeps its limit. A correction for what is left is proposed.</source>
        <translation>验证完成：各轴均在限值以内。对剩余误差提出了修正建议。</translation>
    </message>
    <message>
        <source>Writes the corrected table. Asks first.</source>
        <translation>写入修正后的补偿表。写入前会询问。</translation>
    </message>
    <message>
        <source>At the end: mean of the last tenth.</source>
        <translation>“末段”：最后十分之一的平均值。</translation>
    </message>
    <message>
        <source>Offset</source>
        <translation>偏置</translation>
    </message>
    <message>
        <source>Which of the last two versions is better changes from run to run: record a further warm-up run and update the fit with it.</source>
        <translation>最近两个版本孰优因运行而异：请再记录一次暖机运行，并用它更新拟合。</translation>
    </message>
    <message>
        <source>Outside the model&apos;s range in this run, where it guesses: %1. A further warm-up run that goes there widens the range.</source>
        <translation>本次运行中超出模型有效范围（模型在此仅为推测）：%1。增加一次达到该温度的暖机运行可扩大范围。</translation>
    </message>
    <message>
        <source>%1 is above the limit of %2 µm, but this run left the model&apos;s range: record a further warm-up run that goes there and update the fit with it.</source>
        <translation>%1 超过限值 %2 µm，但本次运行超出了模型的有效范围：请再记录一次达到该温度的暖机运行，并用其更新拟合。</translation>
    </message>
    <message>
        <source>Add note</source>
        <translation>添加备注</translation>
    </message>
    <message>
        <source>Writes a remark at this moment of the run</source>
        <translation>在运行的此刻写入备注</translation>
    </message>
    <message>
        <source>The result below is of before.</source>
        <translation>以下为此前的结果。</translation>
    </message>
    <message>
        <source>Every axis keeps its limit of %1 µm, but less than %2 % of the error is removed in one of them.</source>
        <translation>各轴均在 %1 µm 限值以内，但其中有一轴的误差消除不足 %2 %。</translation>
    </message>
    <message>
        <source>Bring the table back</source>
        <translation>恢复补偿表</translation>
    </message>
    <message>
        <source>Opens Upload, which compares the table with what the machine holds and asks before it writes.</source>
        <translation>打开“上传”页，与机床中的补偿表比较，写入前会询问。</translation>
    </message>
    <message>
        <source>No correction could be computed: %1</source>
        <translation>无法计算修正：%1</translation>
    </message>
    <message>
        <source>Peak of the warm-up</source>
        <translation>暖机峰值</translation>
    </message>
    <message>
        <source>Largest error of the whole warm-up run.</source>
        <translation>整个暖机运行中的最大误差。</translation>
    </message>
    <message>
        <source>The verification was interrupted. Everything stored is here; resume or finish with it.</source>
        <translation>验证已中断。已存储的数据都在这里；可继续，或以现有数据结束。</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>弃用</translation>
    </message>
    <message>
        <source>The verification before counts</source>
        <translation>以前一次验证为准</translation>
    </message>
    <message>
        <source>New run</source>
        <translation>新的运行</translation>
    </message>
    <message>
        <source>The interrupted one stays in the job unused</source>
        <translation>中断的运行留在作业中，但不使用</translation>
    </message>
    <message>
        <source>Plan a further run</source>
        <translation>规划新的暖机运行</translation>
    </message>
    <message>
        <source>Opens Warm-up with a new run to plan; the model is fitted anew with what it shows.</source>
        <translation>打开“暖机”页规划新的运行；随后以其数据重新拟合模型。</translation>
    </message>
    <message>
        <source>Goes on with what is left above the limit</source>
        <translation>在残差仍超过限值的情况下继续</translation>
    </message>
    <message>
        <source>It is left as it is.</source>
        <translation>已选择保持不变。</translation>
    </message>
    <message>
        <source>Verify again, or leave it as it is.</source>
        <translation>请重新验证，或保持不变。</translation>
    </message>
    <message>
        <source>Worse than with version %2: %1. Roll back, or correct it.</source>
        <translation>比版本 %2 差：%1。请回滚或修正。</translation>
    </message>
    <message>
        <source>The run of the warm-up once more, with the compensation on</source>
        <translation>打开补偿，再进行一次暖机运行</translation>
    </message>
    <message>
        <source>Stops the machine; the recording goes on</source>
        <translation>停止机床；记录继续</translation>
    </message>
    <message>
        <source>Goes on with the plan where it was stopped</source>
        <translation>从停止处继续执行计划</translation>
    </message>
    <message>
        <source>A new run with what is written now</source>
        <translation>用现在写入的内容再运行一次</translation>
    </message>
    <message>
        <source>Goes on without the correction</source>
        <translation>不做修正，继续</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::VerifyResult</name>
    <message>
        <source>Axis by axis</source>
        <translation>各轴结果</translation>
    </message>
    <message>
        <source>largest error in the first %1 min of each run</source>
        <translation>每次运行前 %1 min 内的最大误差</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>轴</translation>
    </message>
    <message>
        <source>Without</source>
        <translation>无补偿</translation>
    </message>
    <message>
        <source>Warm-up run, compensation off</source>
        <translation>暖机运行，补偿断开</translation>
    </message>
    <message>
        <source>With</source>
        <translation>有补偿</translation>
    </message>
    <message>
        <source>Verification run, compensation on</source>
        <translation>验证运行，补偿接通</translation>
    </message>
    <message>
        <source>Gain</source>
        <translation>改善</translation>
    </message>
    <message>
        <source>Share of the largest error that is gone</source>
        <translation>最大误差中已消除的比例</translation>
    </message>
    <message>
        <source>At the end</source>
        <translation>末段</translation>
    </message>
    <message>
        <source>Mean of the last tenth: without, with</source>
        <translation>最后十分之一的平均值：无补偿，有补偿</translation>
    </message>
    <message>
        <source>%1 % worse</source>
        <translation>变差 %1 %</translation>
    </message>
    <message>
        <source>%1 % removed</source>
        <translation>消除 %1 %</translation>
    </message>
    <message>
        <source>Worse at the end than without compensation</source>
        <translation>末段比无补偿时更差</translation>
    </message>
    <message>
        <source>Shown when the verification is finished</source>
        <translation>验证结束后显示</translation>
    </message>
    <message>
        <source>without</source>
        <translation>无补偿</translation>
    </message>
    <message>
        <source>with compensation</source>
        <translation>有补偿</translation>
    </message>
    <message>
        <source>Without and with compensation</source>
        <translation>无补偿与有补偿</translation>
    </message>
    <message>
        <source>%1 without and with compensation</source>
        <translation>%1 无补偿与有补偿</translation>
    </message>
    <message>
        <source>time since the start of each run</source>
        <translation>自每次运行开始的时间</translation>
    </message>
    <message>
        <source>limit</source>
        <translation>限值</translation>
    </message>
    <message>
        <source>%1 without</source>
        <translation>%1 无补偿</translation>
    </message>
    <message>
        <source>%1 with compensation</source>
        <translation>%1 有补偿</translation>
    </message>
    <message>
        <source>largest error of the same %1 min</source>
        <translation>同一 %1 分钟内的最大误差</translation>
    </message>
    <message>
        <source>This run less what was applied</source>
        <translation>本次运行减去已施加的补偿</translation>
    </message>
    <message>
        <source>time of the run</source>
        <translation>运行时间</translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::WarmupPage</name>
    <message>
        <source>Warm-up</source>
        <translation>暖机</translation>
    </message>
    <message>
        <source>Choose a plan, change it by dragging, then start. The machine must be cold and at rest.</source>
        <translation>选择计划，可拖动修改，然后开始。机床必须处于冷态且静止。</translation>
    </message>
    <message>
        <source>Steady: %1. More time adds little; finish when you like.</source>
        <translation>已稳定：%1。继续运行意义不大；可随时结束。</translation>
    </message>
    <message>
        <source>The machine warms up. Watch that the errors move and no sensor drops out.</source>
        <translation>机床正在升温。注意误差应有变化，且没有传感器失效。</translation>
    </message>
    <message>
        <source>Paused. The machine stands; the gap stays visible in the recording.</source>
        <translation>已暂停。机床静止；间断会在记录中保留可见。</translation>
    </message>
    <message>
        <source>The run was interrupted. Everything stored is here; resume or finish with it.</source>
        <translation>运行曾被中断。已存储的内容都在；可继续，或以现有内容结束。</translation>
    </message>
    <message>
        <source>The run is complete. Look it over, then go on to the sensors.</source>
        <translation>运行完成。请查看结果，然后进入传感器选择。</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>开始</translation>
    </message>
    <message>
        <source>The compensation is ON. Measuring for the model is locked until it is switched off.</source>
        <translation>补偿处于接通状态。断开之前，禁止测量建模数据。</translation>
    </message>
    <message>
        <source>The plan has no steps yet.</source>
        <translation>计划尚无步骤。</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>暂停</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>继续运行</translation>
    </message>
    <message>
        <source>Use this run</source>
        <translation>使用本次运行</translation>
    </message>
    <message>
        <source>Abort</source>
        <translation>中止</translation>
    </message>
    <message>
        <source>Stops the machine and drops this run. Asks first.</source>
        <translation>停止机床并放弃本次运行。会先询问。</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>结束</translation>
    </message>
    <message>
        <source>Ends the run here and goes on with what was recorded. Asks first.</source>
        <translation>在此结束运行，以已记录的内容继续。会先询问。</translation>
    </message>
    <message>
        <source>Load plan</source>
        <translation>加载计划</translation>
    </message>
    <message>
        <source>Save plan</source>
        <translation>保存计划</translation>
    </message>
    <message>
        <source>Add note</source>
        <translation>添加备注</translation>
    </message>
    <message>
        <source>Writes a remark at this moment of the run</source>
        <translation>在运行的此刻写入备注</translation>
    </message>
    <message>
        <source>New run</source>
        <translation>新运行</translation>
    </message>
    <message>
        <source>Plans a new run; the interrupted one stays in the job unused</source>
        <translation>计划新的运行；被中断的运行留在作业中不使用</translation>
    </message>
    <message>
        <source>Save as CSV</source>
        <translation>保存为 CSV</translation>
    </message>
    <message>
        <source>Expected drift</source>
        <translation>预期漂移</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>测量次数</translation>
    </message>
    <message>
        <source>How often the error is measured. A model needs at least 20.</source>
        <translation>误差的测量次数。模型至少需要 20 次。</translation>
    </message>
    <message>
        <source>Total time</source>
        <translation>总时间</translation>
    </message>
    <message>
        <source>Time of the machine. A virtual machine goes through it faster than the clock on the wall.</source>
        <translation>机床时间。虚拟机床的时间比实际时间快。</translation>
    </message>
    <message>
        <source>Disk free</source>
        <translation>磁盘剩余</translation>
    </message>
    <message>
        <source>Time left</source>
        <translation>剩余时间</translation>
    </message>
    <message>
        <source>of %1</source>
        <translation>共 %1</translation>
    </message>
    <message>
        <source>Time of the machine. All curves and periods are in it; the bar above counts the time on the wall.</source>
        <translation>机床时间。所有曲线和周期均以此计；上方进度条按实际时间计。</translation>
    </message>
    <message>
        <source>Recorded</source>
        <translation>记录</translation>
    </message>
    <message>
        <source>Largest error</source>
        <translation>最大误差</translation>
    </message>
    <message>
        <source>Error slope now</source>
        <translation>当前误差斜率</translation>
    </message>
    <message>
        <source>Heat slope now</source>
        <translation>当前温度斜率</translation>
    </message>
    <message>
        <source>steady</source>
        <translation>稳定</translation>
    </message>
    <message>
        <source>still moving</source>
        <translation>仍在变化</translation>
    </message>
    <message>
        <source>Samples lost</source>
        <translation>丢失的采样</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>Every sample of the plan was stored.</source>
        <translation>计划中的每个采样均已存储。</translation>
    </message>
    <message>
        <source>harmless</source>
        <translation>无影响</translation>
    </message>
    <message>
        <source>The longest time without a sample was %1 of machine time. Temperatures change over minutes: the model is the same without them. It stays in the report.</source>
        <translation>最长有 %1 机床时间没有采样。温度以分钟计变化，缺少这些采样不影响模型。报告中会注明。</translation>
    </message>
    <message>
        <source>a part is missing</source>
        <translation>缺少一段</translation>
    </message>
    <message>
        <source>gap of %1</source>
        <translation>间断 %1</translation>
    </message>
    <message>
        <source>Nothing is known about %1 of machine time. The model does not hold what happened then; a new run is better if the errors moved meanwhile.</source>
        <translation>有 %1 机床时间没有任何信息。模型不包含期间发生的变化；若期间误差有变化，最好重新运行。</translation>
    </message>
    <message>
        <source>No run yet</source>
        <translation>尚无运行</translation>
    </message>
    <message>
        <source>Plan</source>
        <translation>计划</translation>
    </message>
    <message>
        <source>spindle speed in rpm over time</source>
        <translation>主轴转速（r/min）随时间的变化</translation>
    </message>
    <message>
        <source>Step %1</source>
        <translation>步骤 %1</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>时长</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>转速</translation>
    </message>
    <message>
        <source>Axes</source>
        <translation>轴</translation>
    </message>
    <message>
        <source>Coolant</source>
        <translation>冷却液</translation>
    </message>
    <message>
        <source>Sample every</source>
        <translation>采样间隔</translation>
    </message>
    <message>
        <source>Measure every</source>
        <translation>测量间隔</translation>
    </message>
    <message>
        <source>Blue ticks under the plan: here the machine goes to the measuring position.</source>
        <translation>计划下方的蓝色刻度：机床在此处移动到测量位置。</translation>
    </message>
    <message>
        <source> min</source>
        <translation> min</translation>
    </message>
    <message>
        <source> rpm</source>
        <translation> r/min</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>on</source>
        <translation>开</translation>
    </message>
    <message>
        <source>Add step</source>
        <translation>添加步骤</translation>
    </message>
    <message>
        <source>Remove the selected step</source>
        <translation>删除所选步骤</translation>
    </message>
    <message>
        <source>run the path</source>
        <translation>沿路径运动</translation>
    </message>
    <message>
        <source>stand still</source>
        <translation>静止</translation>
    </message>
    <message>
        <source>Choose a plan</source>
        <translation>选择计划</translation>
    </message>
    <message>
        <source>Preset plans</source>
        <translation>预设计划</translation>
    </message>
    <message>
        <source>Step %1 of %2</source>
        <translation>步骤 %1 / %2</translation>
    </message>
    <message>
        <source>in %1</source>
        <translation>%1 轴</translation>
    </message>
    <message>
        <source>Import the recording of your logger: its columns are shown before it is taken.</source>
        <translation>导入您的记录仪的记录：采用之前会显示其各列。</translation>
    </message>
    <message>
        <source>Imported. Look it over, then go on to the sensors.</source>
        <translation>已导入。请查看，然后继续到传感器。</translation>
    </message>
    <message>
        <source>Imported, without errors: the heat can be explained, in Physics.</source>
        <translation>已导入，没有误差：其热行为可在“物理分析”页解释。</translation>
    </message>
    <message>
        <source>Import a recording</source>
        <translation>导入记录</translation>
    </message>
    <message>
        <source>Import</source>
        <translation>导入</translation>
    </message>
    <message>
        <source>A recording of another logger takes the place of the run</source>
        <translation>用其他记录仪的记录取代该运行</translation>
    </message>
    <message>
        <source>Import another</source>
        <translation>导入另一个</translation>
    </message>
    <message>
        <source>heat only</source>
        <translation>仅热量</translation>
    </message>
    <message>
        <source>The recording holds no error: Sensors and Fit need one, Physics does not.</source>
        <translation>记录中没有误差：传感器和拟合需要误差，物理分析不需要。</translation>
    </message>
    <message>
        <source>Temperatures</source>
        <translation>温度</translation>
    </message>
    <message>
        <source>Rows</source>
        <translation>行数</translation>
    </message>
    <message>
        <source>No recording yet</source>
        <translation>还没有记录</translation>
    </message>
    <message>
        <source>The temperatures and errors of your recording appear here. Drop a logger&apos;s table anywhere on the window, or choose it: text, CSV or a workbook, with any names and units.</source>
        <translation>您的记录中的温度和误差将显示在这里。把记录仪的表格拖到窗口任意处，或选择它：文本、CSV 或工作簿，名称和单位不限。</translation>
    </message>
    <message>
        <source>A further run of this machine, or one in place of this</source>
        <translation>本机床的另一次运行，或替换当前运行</translation>
    </message>
    <message>
        <source>Counted again when the controller answers.</source>
        <translation>控制器恢复应答后继续计数。</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>弃用</translation>
    </message>
    <message>
        <source>The run before counts; the interrupted one stays unused</source>
        <translation>以前一次运行为准；中断的运行留存但不使用</translation>
    </message>
    <message>
        <source>A file of any logger: text or Excel</source>
        <translation>任何记录仪的文件：文本或 Excel</translation>
    </message>
    <message>
        <source>The machine runs by the plan; temperatures and errors are recorded</source>
        <translation>机床按计划运行，同时记录温度和误差</translation>
    </message>
    <message>
        <source>Stops the machine; the recording goes on</source>
        <translation>停止机床；记录继续</translation>
    </message>
    <message>
        <source>Goes on with the plan where it was stopped</source>
        <translation>从停止处继续执行计划</translation>
    </message>
    <message>
        <source>Goes on: the sensors are chosen from it</source>
        <translation>继续：由此运行选择传感器</translation>
    </message>
    <message>
        <source>A plan that was saved before</source>
        <translation>以前保存的计划</translation>
    </message>
    <message>
        <source>As a file, for other machines and the command line</source>
        <translation>保存为文件，供其他机床和命令行使用</translation>
    </message>
    <message>
        <source>The recording shown, for a spreadsheet</source>
        <translation>所显示的记录，供电子表格使用</translation>
    </message>
    <message>
        <source>Plans a new run; this one stays in the job</source>
        <translation>计划新的运行；此运行保留在作业中</translation>
    </message>
</context>
<context>
    <name>zerodrift::OperatorText</name>
    <message>
        <source>spindle %1 rpm, coolant on</source>
        <translation>主轴 %1 rpm，冷却液开</translation>
    </message>
    <message>
        <source>spindle %1 rpm, coolant off</source>
        <translation>主轴 %1 rpm，冷却液关</translation>
    </message>
    <message>
        <source>Is the compensation switched on at the control?</source>
        <translation>控制器上的补偿是否已接通？</translation>
    </message>
    <message>
        <source>Set %1, and start the warm-up path</source>
        <translation>设定：%1，并启动预热轨迹</translation>
    </message>
    <message>
        <source>Set %1, no warm-up path</source>
        <translation>设定：%1，不运行预热轨迹</translation>
    </message>
    <message>
        <source>Stop the path and move to %1 mm (%2)</source>
        <translation>停止轨迹，移动到 %1 mm（%2）</translation>
    </message>
    <message>
        <source>Switch the compensation on</source>
        <translation>接通补偿</translation>
    </message>
    <message>
        <source>Switch the compensation off</source>
        <translation>断开补偿</translation>
    </message>
    <message>
        <source>Enter a test offset of X %1, Y %2, Z %3 um</source>
        <translation>输入试验偏移：X %1、Y %2、Z %3 um</translation>
    </message>
    <message>
        <source>Load the table %1 into the control, then type the check value that it shows</source>
        <translation>将补偿表 %1 载入控制器，然后输入其显示的校验值</translation>
    </message>
    <message>
        <source>Type the check value that the control shows for its table</source>
        <translation>输入控制器为其补偿表显示的校验值</translation>
    </message>
</context>
</TS>
