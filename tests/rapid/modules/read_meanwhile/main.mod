! RAPID Instructions, StartLoad: the file is read meanwhile; WaitLoad links it, and tells what was wrong with it.
MODULE read_meanwhile
  VAR loadsession job;
  VAR string said;

  PROC main()
    StartLoad\Dynamic,"HOME:"\File:="PART_A.MOD",job;
    TPWrite "meanwhile";                    ! -> meanwhile
    WaitLoad job;
    %"go_a"% said;
    TPWrite said;                           ! -> part a
    StartLoad\Dynamic,"HOME:/PART_B.MOD",job;
    StartLoad\Dynamic,"HOME:/PART_A.MOD",job;
    WaitLoad\UnloadPath:="HOME:/PART_A.MOD",job;
    %"go_b"% said;
    TPWrite said;                           ! -> part b
    %"go_a"% said;
    TPWrite said;                           ! -> part b
    WaitLoad job;
    StartLoad\Dynamic,"HOME:/NOTHING.MOD",job;
    WaitLoad job;
    CancelLoad job;
    StartLoad\Dynamic,"HOME:/PART_B.MOD",job;
    WaitLoad job;
    CancelLoad job;
    UnLoad "HOME:/PART_B.MOD";
    UnLoad "HOME:/PART_B.MOD";
    EraseModule "NOBODY";
    Load\Dynamic,"HOME:/PART_A.MOD";
    Load\Dynamic,"HOME:/PART_A.MOD";
    EraseModule "PART_A";
    TPWrite "end";                          ! -> end
  ERROR
    TEST ERRNO
    CASE ERR_REFUNKPRC:
      TPWrite "no procedure";               ! -> no procedure
    CASE ERR_LOADNO_INUSE:
      TPWrite "session in use";             ! -> session in use
    CASE ERR_LOADNO_NOUSE:
      TPWrite "session not in use";         ! -> session not in use ! -> session not in use
    CASE ERR_FILNOTFND:
      TPWrite "no file";                    ! -> no file
    CASE ERR_LOADED:
      TPWrite "loaded already";             ! -> loaded already ! -> loaded already
    CASE ERR_UNLOAD:
      TPWrite "not to be unloaded";         ! -> not to be unloaded
    CASE ERR_MODULE:
      TPWrite "no module";                  ! -> no module
    CASE ERR_UNKPROC:
      TPWrite "no session";                 ! -> no session
    DEFAULT:
      TPWrite "unknown";
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
