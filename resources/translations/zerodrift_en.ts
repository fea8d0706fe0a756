<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
<context>
    <name>zerodrift::desktop::AxisErrorsPresenter</name>
    <message numerus="yes">
        <source>%1: %n target(s)</source>
        <translation>
            <numerusform>%1: %n target</numerusform>
            <numerusform>%1: %n targets</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n run(s)</source>
        <translation>
            <numerusform>%n run</numerusform>
            <numerusform>%n runs</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::MapEditor</name>
    <message numerus="yes">
        <source>no %1 without %2 and %n more</source>
        <translation>
            <numerusform>no %1 without %2 and %n more</numerusform>
            <numerusform>no %1 without %2 and %n more</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::RigEditor</name>
    <message numerus="yes">
        <source>%n sensor(s) added; see Signals.</source>
        <translation>
            <numerusform>%n sensor added; see Signals.</numerusform>
            <numerusform>%n sensors added; see Signals.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::SensorsPresenter</name>
    <message numerus="yes">
        <source>%n proposed: one speed does not tell which of them matter at another. A run at a second speed does.</source>
        <translation>
            <numerusform>%n proposed: one speed does not tell which matter at another. A run at a second speed does.</numerusform>
            <numerusform>%n proposed: one speed does not tell which of them matter at another. A run at a second speed does.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n proposed: with %1 the error to expect would be only %2 µm less.</source>
        <translation>
            <numerusform>%n proposed: with %1 the error to expect would be only %2 µm less.</numerusform>
            <numerusform>%n proposed: with %1 the error to expect would be only %2 µm less.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Within the limit only %n would remain, fewer than there are clusters.</source>
        <translation>
            <numerusform>Within the limit only %n would remain, fewer than there are clusters.</numerusform>
            <numerusform>Within the limit only %n would remain, fewer than there are clusters.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Within the limit only %n would remain.</source>
        <translation>
            <numerusform>Within the limit only %n would remain.</numerusform>
            <numerusform>Within the limit only %n would remain.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Within the limit only %n would remain, for an error of %1 µm more.</source>
        <translation>
            <numerusform>Within the limit only %n would remain, for an error of %1 µm more.</numerusform>
            <numerusform>Within the limit only %n would remain, for an error of %1 µm more.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::UploadPresenter</name>
    <message numerus="yes">
        <source>%n register(s)</source>
        <translation>
            <numerusform>%n register</numerusform>
            <numerusform>%n registers</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n warning(s), in the details. The first: %1</source>
        <translation>
            <numerusform>%n warning, in the details: %1</numerusform>
            <numerusform>%n warnings, in the details. The first: %1</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::WarmupPresenter</name>
    <message numerus="yes">
        <source>%n temperatures</source>
        <translation>
            <numerusform>%n temperature</numerusform>
            <numerusform>%n temperatures</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n errors</source>
        <translation>
            <numerusform>%n error</numerusform>
            <numerusform>%n errors</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::desktop::Workbench</name>
    <message numerus="yes">
        <source>Connected to %1 again, after %n attempt(s) that failed</source>
        <translation>
            <numerusform>Connected to %1 again, after one attempt that failed</numerusform>
            <numerusform>Connected to %1 again, after %n attempts that failed</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::CalibratePage</name>
    <message numerus="yes">
        <source>%n reference mark(s)</source>
        <translation>
            <numerusform>%n reference mark</numerusform>
            <numerusform>%n reference marks</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::ImportDialog</name>
    <message numerus="yes">
        <source>and %n more</source>
        <translation>
            <numerusform>and %n more</numerusform>
            <numerusform>and %n more</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::MachinePage</name>
    <message numerus="yes">
        <source>%n to check</source>
        <translation>
            <numerusform>%n to check</numerusform>
            <numerusform>%n to check</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::PhysicsPage</name>
    <message numerus="yes">
        <source>with %n adopted</source>
        <translation>
            <numerusform>with %n adopted</numerusform>
            <numerusform>with %n adopted</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::RigSetup</name>
    <message numerus="yes">
        <source>%n assigned</source>
        <translation>
            <numerusform>%n assigned</numerusform>
            <numerusform>%n assigned</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>zerodrift::ui::RunView</name>
    <message numerus="yes">
        <source>%n channels</source>
        <translation>
            <numerusform>%n channel</numerusform>
            <numerusform>%n channels</numerusform>
        </translation>
    </message>
</context>
</TS>
