"""The numbers behind RAPID's error names.

ABB publishes names, not numbers: programs compare ERRNO with names. The numbers here are our own
and stable: a new name is appended, none is ever reused. They avoid 1 to 90, which programs raise
themselves, and the real numbers of the controller, so that a program that compares with a raw
number never matches by accident.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "errnum"; the
event log messages of RobotWare for `EVENTS`.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from rapidsim.language.errors import RapidError

ERR_ACC_TOO_LOW: Final = 20001.0
ERR_ACTIV_PROF: Final = 20002.0
ERR_ADDR_INUSE: Final = 20003.0
ERR_ALIASIO_DEF: Final = 20004.0
ERR_ALIASIO_TYPE: Final = 20005.0
ERR_ALRDYCNT: Final = 20006.0
ERR_ALRDY_MOVING: Final = 20007.0
ERR_AO_LIM: Final = 20008.0
ERR_ARGDUPCND: Final = 20009.0
ERR_ARGNAME: Final = 20010.0
ERR_ARGNOTPER: Final = 20011.0
ERR_ARGNOTVAR: Final = 20012.0
ERR_ARGVALERR: Final = 20013.0
ERR_ARRAY_SIZE: Final = 20014.0
ERR_AXIS_ACT: Final = 20015.0
ERR_AXIS_IND: Final = 20016.0
ERR_AXIS_MOVING: Final = 20017.0
ERR_AXIS_PAR: Final = 20018.0
ERR_BUSSTATE: Final = 20019.0
ERR_BWDLIMIT: Final = 20020.0
ERR_CALC_DIVZERO: Final = 20021.0
ERR_CALC_NEG: Final = 20022.0
ERR_CALC_OVERFLOW: Final = 20023.0
ERR_CALLIO_INTER: Final = 20024.0
ERR_CALLPROC: Final = 20025.0
ERR_CAM_BUSY: Final = 20026.0
ERR_CAM_COM_TIMEOUT: Final = 20027.0
ERR_CAM_GET_MISMATCH: Final = 20028.0
ERR_CAM_MAXTIME: Final = 20029.0
ERR_CAM_NO_MORE_DATA: Final = 20030.0
ERR_CAM_NO_PROGMODE: Final = 20031.0
ERR_CAM_NO_RUNMODE: Final = 20032.0
ERR_CAM_SET_MISMATCH: Final = 20033.0
ERR_CFG_ILLTYPE: Final = 20034.0
ERR_CFG_ILL_DOMAIN: Final = 20035.0
ERR_CFG_INTERNAL: Final = 20036.0
ERR_CFG_LIMIT: Final = 20037.0
ERR_CFG_NOTFND: Final = 20038.0
ERR_CFG_OUTOFBOUNDS: Final = 20039.0
ERR_CFG_WRITEFILE: Final = 20040.0
ERR_CNTNOTVAR: Final = 20041.0
ERR_CNV_CONNECT: Final = 20042.0
ERR_CNV_DROPPED: Final = 20043.0
ERR_CNV_NOT_ACT: Final = 20044.0
ERR_COLL_STOP: Final = 20045.0
ERR_COMM_EXT: Final = 20046.0
ERR_COMM_INIT: Final = 20047.0
ERR_COMM_INIT_FAILED: Final = 20048.0
ERR_CONC_MAX: Final = 20049.0
ERR_CONTACTL: Final = 20050.0
ERR_CSV_INDEX: Final = 20051.0
ERR_DA_UNKPROC: Final = 20052.0
ERR_DATA_RECV: Final = 20053.0
ERR_DEV_MAXTIME: Final = 20054.0
ERR_DIPLAG_LIM: Final = 20055.0
ERR_DIVZERO: Final = 20056.0
ERR_DROP_LOAD: Final = 20057.0
ERR_EXCRTYMAX: Final = 20058.0
ERR_EXECPHR: Final = 20059.0
ERR_FILEACC: Final = 20060.0
ERR_FILEEXIST: Final = 20061.0
ERR_FILEOPEN: Final = 20062.0
ERR_FILESIZE: Final = 20063.0
ERR_FILNOTFND: Final = 20064.0
ERR_FNCNORET: Final = 20065.0
ERR_FRAME: Final = 20066.0
ERR_FRICTUNE_FATAL: Final = 20067.0
ERR_GLUEFLOW: Final = 20068.0
ERR_GO_LIM: Final = 20069.0
ERR_HAND_FAILEDGRIPPOS: Final = 20070.0
ERR_HAND_FAILEDMOVEPOS: Final = 20071.0
ERR_HAND_FAILEDVACUUM: Final = 20072.0
ERR_HAND_NOTCALIBRATED: Final = 20073.0
ERR_ILLDIM: Final = 20074.0
ERR_ILLQUAT: Final = 20075.0
ERR_ILLRAISE: Final = 20076.0
ERR_INDCNV_ORDER: Final = 20077.0
ERR_INOISSAFE: Final = 20078.0
ERR_INOMAX: Final = 20079.0
ERR_INPAR_RDONLY: Final = 20080.0
ERR_INT_MAXVAL: Final = 20081.0
ERR_INT_NOTVAL: Final = 20082.0
ERR_INVDIM: Final = 20083.0
ERR_IODISABLE: Final = 20084.0
ERR_IODN_TIMEOUT: Final = 20085.0
ERR_IOENABLE: Final = 20086.0
ERR_IOERROR: Final = 20087.0
ERR_IPSDEVICE_UNKNOWN: Final = 20088.0
ERR_IPSILLEGAL_CH_OR_FAC: Final = 20089.0
ERR_IPS_PARAM: Final = 20090.0
ERR_ITMSRC_UNDEF: Final = 20091.0
ERR_LINKREF: Final = 20092.0
ERR_LOADED: Final = 20093.0
ERR_LOADID_FATAL: Final = 20094.0
ERR_LOADID_RETRY: Final = 20095.0
ERR_LOADNO_INUSE: Final = 20096.0
ERR_LOADNO_NOUSE: Final = 20097.0
ERR_MSG_PENDING: Final = 20098.0
ERR_MAXINTVAL: Final = 20099.0
ERR_MOC_CNV_REC_FILE_UNKNOWN: Final = 20100.0
ERR_MODULE: Final = 20101.0
ERR_MOD_NOT_LOADED: Final = 20102.0
ERR_MOD_NOTLOADED: Final = 20103.0
ERR_MT_ABORT: Final = 20104.0
ERR_MT_HOME: Final = 20105.0
ERR_MT_HOMERUN: Final = 20106.0
ERR_NEGARG: Final = 20107.0
ERR_NAME_INVALID: Final = 20108.0
ERR_NORUNUNIT: Final = 20109.0
ERR_NOTARR: Final = 20110.0
ERR_NOTEQDIM: Final = 20111.0
ERR_NOTINTVAL: Final = 20112.0
ERR_NOTPRES: Final = 20113.0
ERR_NOTSAVED: Final = 20114.0
ERR_NOT_MOVETASK: Final = 20115.0
ERR_NO_ALIASIO_DEF: Final = 20116.0
ERR_NO_SGUN: Final = 20117.0
ERR_NUM_LIMIT: Final = 20118.0
ERR_OUTOFBND: Final = 20119.0
ERR_OUTSIDE_REACH: Final = 20120.0
ERR_OVERFLOW: Final = 20121.0
ERR_PATH: Final = 20122.0
ERR_PATHDIST: Final = 20123.0
ERR_PATH_STOP: Final = 20124.0
ERR_PERSSUPSEARCH: Final = 20125.0
ERR_PID_MOVESTOP: Final = 20126.0
ERR_PID_RAISE_PP: Final = 20127.0
ERR_PPA_TIMEOUT: Final = 20128.0
ERR_PRGMEMFULL: Final = 20129.0
ERR_PROCSIGNAL_OFF: Final = 20130.0
ERR_PROGSTOP: Final = 20131.0
ERR_RANYBIN_CHK: Final = 20132.0
ERR_RANYBIN_EOF: Final = 20133.0
ERR_RCVDATA: Final = 20134.0
ERR_REFUNKDAT: Final = 20135.0
ERR_REFUNKFUN: Final = 20136.0
ERR_REFUNKPRC: Final = 20137.0
ERR_REFUNKTRP: Final = 20138.0
ERR_RMQ_DIM: Final = 20139.0
ERR_RMQ_FULL: Final = 20140.0
ERR_RMQ_INVALID: Final = 20141.0
ERR_RMQ_INVMSG: Final = 20142.0
ERR_RMQ_MSGSIZE: Final = 20143.0
ERR_RMQ_NAME: Final = 20144.0
ERR_RMQ_NOMSG: Final = 20145.0
ERR_RMQ_TIMEOUT: Final = 20146.0
ERR_RMQ_VALUE: Final = 20147.0
ERR_ROBLIMIT: Final = 20148.0
ERR_SC_WRITE: Final = 20149.0
ERR_SGUN_ESTOP: Final = 20150.0
ERR_SGUN_MOTOFF: Final = 20151.0
ERR_SGUN_NEGVAL: Final = 20152.0
ERR_SGUN_NOTACT: Final = 20153.0
ERR_SGUN_NOTINIT: Final = 20154.0
ERR_SGUN_NOTOPEN: Final = 20155.0
ERR_SGUN_NOTSYNC: Final = 20156.0
ERR_SIG_NAME: Final = 20157.0
ERR_SIGSUPSEARCH: Final = 20158.0
ERR_SIG_NOT_VALID: Final = 20159.0
ERR_SOCK_ADDR_INVALID: Final = 20160.0
ERR_SOCK_ADDR_INUSE: Final = 20161.0
ERR_SOCK_CLOSED: Final = 20162.0
ERR_SOCK_IS_BOUND: Final = 20163.0
ERR_SOCK_IS_CONN: Final = 20164.0
ERR_SOCK_NET_UNREACH: Final = 20165.0
ERR_SOCK_NOT_BOUND: Final = 20166.0
ERR_SOCK_NOT_CONN: Final = 20167.0
ERR_SOCK_TIMEOUT: Final = 20168.0
ERR_SOCK_UNSPEC: Final = 20169.0
ERR_SPEEDLIM_VALUE: Final = 20170.0
ERR_SPEED_REFRESH_LIM: Final = 20171.0
ERR_STARTMOVE: Final = 20172.0
ERR_STORE_PROF: Final = 20173.0
ERR_STRTOOLNG: Final = 20174.0
ERR_SYMBOL_TYPE: Final = 20175.0
ERR_SYM_ACCESS: Final = 20176.0
ERR_SYNCMOVEOFF: Final = 20177.0
ERR_SYNCMOVEON: Final = 20178.0
ERR_SYNTAX: Final = 20179.0
ERR_TASKNAME: Final = 20180.0
ERR_TP_DIBREAK: Final = 20181.0
ERR_TP_DOBREAK: Final = 20182.0
ERR_TP_MAXTIME: Final = 20183.0
ERR_TP_NO_CLIENT: Final = 20184.0
ERR_TP_PERSBOOLBREAK: Final = 20185.0
ERR_TRUSTLEVEL: Final = 20186.0
ERR_TXTNOEXIST: Final = 20187.0
ERR_UDPUC_COMM: Final = 20188.0
ERR_UISHOW_FATAL: Final = 20189.0
ERR_UISHOW_FULL: Final = 20190.0
ERR_UI_INITVALUE: Final = 20191.0
ERR_UI_MAXMIN: Final = 20192.0
ERR_UI_NOTINT: Final = 20193.0
ERR_UNIT_PAR: Final = 20194.0
ERR_UNKINO: Final = 20195.0
ERR_UNKPROC: Final = 20196.0
ERR_UNLOAD: Final = 20197.0
ERR_USE_PROF: Final = 20198.0
ERR_WAITSYNCTASK: Final = 20199.0
ERR_WAIT_MAX: Final = 20200.0
ERR_WAIT_MAXTIME: Final = 20201.0
ERR_WHL_SEARCH: Final = 20202.0
ERR_WHLSEARCH: Final = 20203.0
ERR_WOBJ_MOVING: Final = 20204.0
CORR_NOFREE: Final = 20205.0
CORR_NOOBJECT: Final = 20206.0
CORR_NOTCONN: Final = 20207.0
SEN_BUSY: Final = 20208.0
SEN_CAALARM: Final = 20209.0
SEN_CAMCHECK: Final = 20210.0
SEN_EXALARM: Final = 20211.0
SEN_GENERRO: Final = 20212.0
SEN_NO_MEAS: Final = 20213.0
SEN_NOREADY: Final = 20214.0
SEN_TEMP: Final = 20215.0
SEN_TIMEOUT: Final = 20216.0
SEN_UNKNOWN: Final = 20217.0
SEN_VALUE: Final = 20218.0
LONG_JMP_ALL_ERR: Final = 20219.0
ERR_INT_PERS_LOCAL: Final = 20220.0
ERR_MOTIONSUP: Final = 20221.0
ERR_FIT_POINTS_IN_LINE: Final = 20222.0
ERR_FIT_TOO_FEW_POINTS: Final = 20223.0
ERR_FIT_TOO_MANY_POINTS: Final = 20224.0
ERR_HAND_AUGOUTOFRANGE: Final = 20225.0
ERR_HAND_FAILEDGRIP: Final = 20226.0
ERR_HAND_FAILEDGRIPINWARD: Final = 20227.0
ERR_HAND_FAILEDGRIPOUTWARD: Final = 20228.0
ERR_HAND_FAILEDMOVE: Final = 20229.0
ERR_HAND_SYSERROR: Final = 20230.0
ERR_HAND_WRONGSTATE: Final = 20231.0

NUMBERS: Mapping[str, float] = MappingProxyType(
    {
        name: value
        for name, value in sorted(globals().items())
        if name.startswith(("ERR_", "CORR_", "SEN_", "LONG_JMP_"))
    }
)
"""Number by name, for the names that programs use."""

_NAMES = {number: name for name, number in NUMBERS.items()}

EVENTS: Mapping[float, int] = MappingProxyType(
    {
        # Numbers at run time; loading a program has other numbers for 40155 to 40170.
        ERR_ARGNOTPER: 40155,
        ERR_ARGNOTVAR: 40156,
        ERR_CNTNOTVAR: 40157,
        ERR_MAXINTVAL: 40158,
        ERR_NOTINTVAL: 40159,
        ERR_REFUNKDAT: 40165,
        ERR_REFUNKFUN: 40166,
        ERR_REFUNKPRC: 40168,
        ERR_REFUNKTRP: 40170,
        ERR_ALRDYCNT: 40191,
        ERR_ARGDUPCND: 40192,
        ERR_CALLPROC: 40193,
        ERR_DIVZERO: 40194,
        ERR_EXCRTYMAX: 40195,
        ERR_EXECPHR: 40196,
        ERR_FNCNORET: 40197,
        ERR_ILLQUAT: 40198,
        ERR_ILLRAISE: 40199,
        ERR_INOMAX: 40200,
        ERR_NOTEQDIM: 40202,
        ERR_NOTPRES: 40203,
        ERR_OUTOFBND: 40204,
        ERR_STRTOOLNG: 40205,
        ERR_ILLDIM: 40241,
        ERR_NOTARR: 40242,
        ERR_UNKINO: 40243,
        ERR_INOISSAFE: 40246,
        ERR_UDPUC_COMM: 41822,
    }
)
"""The controller's event number for the errors that have one."""
_UNHANDLED_RAISE: Final = 40229
"""Event of an error that a program raised itself and no clause handles."""

MAX_RETRIES: Final = 4
"""Default of the controller's system parameter No Of Retry."""
IN_NO_HANDLER: Final = 0.0
"""HANDLER_NONE of ExecHandler: the body of a routine runs."""
IN_ERROR: Final = 2.0
"""HANDLER_ERR: an ERROR clause runs."""
IN_UNDO: Final = 3.0
"""HANDLER_UNDO: an UNDO clause runs."""
FIRST_BOOKED: Final = 20501.0
"""First number that BookErrNo assigns."""


def rapid_error(errno: float, message: str, *, name: str | None = None) -> RapidError:
    """An error that ERROR clauses can catch, with the controller's event number if known.

    Args:
        errno: One of the numbers of this file, or one of the program.
        message: One line for the user: what is wrong and by how much.
        name: The number as the program writes it.
    """
    return RapidError(errno, message, cf=event_of(errno), name=name)


def name_of(error: RapidError) -> str:
    """The name of an error's number: RAPID's, else the program's, else the number as text."""
    return _NAMES.get(error.errno) or error.name or f"{error.errno:g}"


def event_of(errno: float) -> str | None:
    """The controller's event for an error, such as `ABB 40194`; None if it is unknown."""
    event = EVENTS.get(errno) if errno in _NAMES else _UNHANDLED_RAISE
    return None if event is None else f"ABB {event}"


def named(error: RapidError) -> str:
    """Message of an error with its name for ERROR clauses: `... (ERR_DIVZERO)`."""
    name = _NAMES.get(error.errno)
    return error.message if name is None or name in error.message else f"{error.message} ({name})"
