"""The named numbers of RobotWare: type, the number of the first name, names in order.

ABB publishes few of the numbers; those are used, and the others follow the order in which the
manuals list the names.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "Data types";
application manuals of the options; "iounit_state" and "busstate" as programs compare with them.
"""

from __future__ import annotations

_OPERATOR = (
    ("btnres", 0, "resUnkwn resOK resAbort resRetry resIgnore resCancel resYes resNo"),
    ("buttondata", -1, "btnNone btnOK btnAbrtRtryIgn btnOKCancel btnRetryCancel btnYesNo"),
    ("buttondata", 5, "btnYesNoCancel"),
    ("icondata", 0, "iconNone iconInfo iconWarning iconError iconQuestion"),
    ("tpnum", 1, "TP_LATEST TP_PROGRAM TP_SCREENVIEWER"),
)
_MOTION = (
    ("motionprocessmode", 1, "OPTIMAL_CYCLE_TIME_MODE LOW_SPEED_ACCURACY_MODE"),
    ("motionprocessmode", 3, "LOW_SPEED_STIFF_MODE ACCURACY_MODE"),
    ("motionprocessmode", 5, "MPM_USER_MODE_1 MPM_USER_MODE_2 MPM_USER_MODE_3 MPM_USER_MODE_4"),
    ("stoppoint", 1, "inpos stoptime fllwtime"),
    ("triggmode", 1, "TRIGG_MODE1 TRIGG_MODE2 TRIGG_MODE3"),
    ("tunetype", 0, "TUNE_DF TUNE_KP TUNE_KV TUNE_TI TUNE_FRIC_LEV TUNE_FRIC_RAMP"),
    ("tunetype", 6, "TUNE_DG TUNE_DH TUNE_DI TUNE_DK TUNE_DL"),
    ("loadidnum", 1, "MASS_KNOWN MASS_WITH_AX3"),
    ("paridnum", 1, "TOOL_LOAD_ID PAY_LOAD_ID IRBP_K IRBP_L IRBP_C IRBP_C_INDEX IRBP_T IRBP_R"),
    ("paridnum", 9, "IRBP_A IRBP_B IRBP_D"),
    ("paridvalidnum", 10, "ROB_LOAD_VAL ROB_NOT_LOAD_VAL ROB_LM1_LOAD_VAL"),
)
_SIGNALS = (
    ("aiotrigg", 1, "AIO_ABOVE_HIGH AIO_BELOW_HIGH AIO_ABOVE_LOW AIO_BELOW_LOW AIO_BETWEEN"),
    ("aiotrigg", 6, "AIO_OUTSIDE AIO_ALWAYS"),
    ("busstate", 0, "BUSSTATE_HALTED BUSSTATE_RUN BUSSTATE_ERROR BUSSTATE_STARTUP BUSSTATE_INIT"),
    ("busstate", 10, "IOBUS_LOG_STATE_STOPPED IOBUS_LOG_STATE_STARTED"),
    ("busstate", 20, "IOBUS_PHYS_STATE_HALTED IOBUS_PHYS_STATE_RUNNING IOBUS_PHYS_STATE_ERROR"),
    ("busstate", 23, "IOBUS_PHYS_STATE_STARTUP IOBUS_PHYS_STATE_INIT"),
    ("dionum", 0, "low high edge"),
    ("iounit_state", 1, "IOUNIT_RUNNING IOUNIT_RUNERROR IOUNIT_DISABLE IOUNIT_OTHERERR"),
    ("iounit_state", 10, "IOUNIT_LOG_STATE_DISABLED IOUNIT_LOG_STATE_ENABLED"),
    ("iounit_state", 20, "IOUNIT_PHYS_STATE_DEACTIVATED IOUNIT_PHYS_STATE_RUNNING"),
    ("iounit_state", 22, "IOUNIT_PHYS_STATE_ERROR IOUNIT_PHYS_STATE_UNCONNECTED"),
    ("iounit_state", 24, "IOUNIT_PHYS_STATE_UNCONFIGURED IOUNIT_PHYS_STATE_STARTUP"),
    ("iounit_state", 26, "IOUNIT_PHYS_STATE_INIT"),
    ("signalorigin", 0, "SIGORIG_NONE SIGORIG_CFG SIGORIG_ALIAS"),
    ("socketstatus", 1, "SOCKET_CREATED SOCKET_CONNECTED SOCKET_BOUND SOCKET_LISTENING"),
    ("socketstatus", 5, "SOCKET_CLOSED"),
)
_SYSTEM = (
    ("cfgdomain", 0, "ALL_DOMAINS EIO_DOMAIN MMC_DOMAIN MOC_DOMAIN PROC_DOMAIN SIO_DOMAIN"),
    ("cfgdomain", 6, "SYS_DOMAIN"),
    ("errdomain", 0, "COMMON_ERR OP_STATE SYSTEM_ERR HARDWARE_ERR PROGRAM_ERR MOTION_ERR"),
    ("errdomain", 6, "OPERATOR_ERR IO_COM_ERR USER_DEF_ERR SAFETY_ERR"),
    ("errdomain", 11, "PROCESS_ERR CFG_ERR OPTION_PROD_ERR ARCWELD_ERR SPOTWELD_ERR PAINT_ERR"),
    ("errdomain", 17, "PICKWARE_ERR"),
    ("errtype", 0, "TYPE_ALL TYPE_STATE TYPE_WARN TYPE_ERR"),
    ("event_type", 0, "EVENT_NONE EVENT_POWERON EVENT_START EVENT_STOP EVENT_QSTOP"),
    ("event_type", 5, "EVENT_RESTART EVENT_RESET EVENT_STEP"),
    ("exec_level", 0, "LEVEL_NORMAL LEVEL_TRAP LEVEL_SERVICE"),
    ("handler_type", 0, "HANDLER_NONE HANDLER_BWD HANDLER_ERR HANDLER_UNDO"),
    ("opcalc", 1, "OpAdd OpSub OpMult OpDiv OpMod"),
    ("opnum", 1, "LT LTEQ EQ NOTEQ GT GTEQ"),
    ("symnum", 0, "OP_UNDEF OP_AUTO OP_MAN_PROG OP_MAN_TEST"),
    ("symnum", 0, "RUN_UNDEF RUN_CONT_CYCLE RUN_INSTR_FWD RUN_INSTR_BWD RUN_SIM RUN_STEP_MOVE"),
    ("tsp_status", 0, "TSP_STATUS_NOT_NORMAL_TASK TSP_STATUS_DEACT TSP_STATUS_DEACT_SERV_ROUT"),
    ("tsp_status", 3, "TSP_STATUS_ACT"),
    ("tsp_status", 10, "TSP_UNCHECKED_RUN_SERV_ROUT TSP_NORMAL_UNCHECKED TSP_STATIC_UNCHECKED"),
    ("tsp_status", 13, "TSP_SEMISTATIC_UNCHECKED TSP_NORMAL_CHECKED TSP_STATIC_CHECKED"),
    ("tsp_status", 16, "TSP_SEMISTATIC_CHECKED"),
)
_OPTIONS = (
    # Programs have unrelated data with the name `speed`.
    ("testsignal", 1, "resolver_angle"),
    ("testsignal", 4, "speed_ref"),
    ("testsignal", 6, "speed"),
    ("testsignal", 9, "torque_ref"),
    ("testsignal", 102, "dig_input1 dig_input2"),
    ("tunegtype", 1, "RampTorqRefOpen RampTorqRefClose KV SpeedLimit CollAlarmTorq CollContactPos"),
    ("tunegtype", 7, "CollisionSpeed CloseTimeAdjust ForceReadyDelayT PostSyncTime CalibTime"),
    ("tunegtype", 12, "CalibForceLow CalibForceHigh"),
    ("egmframetype", 0, "EGM_FRAME_BASE EGM_FRAME_TOOL EGM_FRAME_WOBJ EGM_FRAME_WORLD"),
    ("egmframetype", 4, "EGM_FRAME_JOINT"),
    ("egmstate", 0, "EGM_STATE_DISCONNECTED EGM_STATE_CONNECTED EGM_STATE_RUNNING"),
    ("egmstopmode", 0, "EGM_STOP_HOLD EGM_STOP_RAMP_DOWN"),
    ("sensorstate", -1, "STATE_ERROR STATE_UNDEFINED STATE_CONNECTED STATE_OPERATING STATE_CLOSED"),
    # Variables of a sensor for seams.
    ("num", 3, "LTAPP__RESET LTAPP__PING LTAPP__CAMCHECK LTAPP__POWER_UP LTAPP__LASER_OFF"),
    ("num", 8, "LTAPP__X LTAPP__Y LTAPP__Z LTAPP__GAP LTAPP__MISMATCH LTAPP__AREA"),
    ("num", 14, "LTAPP__THICKNESS LTAPP__STEPDIR LTAPP__JOINT_NO LTAPP__AGE LTAPP__ANGLE"),
    ("num", 19, "LTAPP__UNIT"),
    ("num", 31, "LTAPP__APM_P1 LTAPP__APM_P2 LTAPP__APM_P3 LTAPP__APM_P4 LTAPP__APM_P5"),
    ("num", 36, "LTAPP__APM_P6"),
    ("num", 51, "LTAPP__ROT_Y LTAPP__ROT_Z"),
    ("num", 54, "LTAPP__X0 LTAPP__Y0 LTAPP__Z0 LTAPP__X1 LTAPP__Y1 LTAPP__Z1 LTAPP__X2 LTAPP__Y2"),
    ("num", 62, "LTAPP__Z2"),
    # The direction and the frame of a soft servo in space.
    ("css_offset_dir", 1, "CSS_POSX CSS_NEGX CSS_POSY CSS_NEGY CSS_POSZ CSS_NEGZ"),
    ("css_soft_dir", 1, "CSS_X CSS_Y CSS_Z CSS_XY CSS_XZ CSS_YZ CSS_XYZ CSS_XYRZ CSS_ARM_ANGLE"),
    ("css_ref_frame", 0, "CSS_REFFRAME_TOOL CSS_REFFRAME_WOBJ"),
    # Events of a process of the Continuous Application Platform.
    ("num", 0, "CAP_START START_PRE PRE_STARTED START_MAIN MAIN_STARTED STOP_WEAVESTART"),
    ("num", 6, "WEAVESTART_REGAIN MOTION_DELAY STARTSPEED_TIME MAIN_MOTION MOVE_STARTED RESTART"),
    ("num", 12, "NEW_INSTR AT_POINT AT_RESTARTPOINT LAST_SEGMENT PROCESS_END_POINT END_MAIN"),
    ("num", 18, "MAIN_ENDED PATH_END_POINT PROCESS_ENDED END_POST1 POST1_ENDED END_POST2"),
    ("num", 24, "POST2_ENDED CAP_STOP CAP_PF_RESTART EQUIDIST AT_ERRORPOINT FLY_START FLY_END"),
    ("num", 31, "LAST_INSTR_ENDED END_PRE PRE_ENDED START_POST1 POST1_STARTED START_POST2"),
    ("num", 37, "POST2_STARTED"),
)

ENUMERATIONS: tuple[tuple[str, int, str], ...] = (
    *_OPERATOR,
    *_MOTION,
    *_SIGNALS,
    *_SYSTEM,
    *_OPTIONS,
)
"""Type, the number of the first name, and the names, numbered consecutively from it."""
OF_OPTIONS = frozenset(name.lower() for _, _, names in _OPTIONS for name in names.split())
"""Folded names that only a controller with the option has."""
