! RAPID Functions, DnumToNum: what a num cannot hold.
MODULE what_a_num_holds
  PROC main()
    VAR num n;
    VAR dnum d:=4294967295;
    n:=DnumToNum(123456789);
    TPWrite ValToStr(n);                    ! -> 1.23457E+08
    n:=DnumToNum(16777217\Integer);
    n:=DnumToNum(1.5\Integer);
    n:=DnumToNum(1E100);
    d:=NumToDnum(0.1);
    TPWrite DnumToStr(d,3);                 ! -> 0.100
    SetGO goPart,4294967296;                ! warning: I801
    SetGO goPart,-1;
    PulseDO\PLength:=0,doOne;               ! warning: I801
    TPWrite "end";                          ! -> end
  ERROR
    TEST ERRNO
    CASE ERR_INT_MAXVAL:
      TPWrite "too large";
    CASE ERR_INT_NOTVAL:
      TPWrite "not whole";                  ! -> not whole
    CASE ERR_ARGVALERR:
      TPWrite "value";                      ! -> value ! -> value
    CASE ERR_GO_LIM:
      TPWrite "group";                      ! -> group ! -> group
    CASE ERR_NUM_LIMIT:
      TPWrite "limit";                      ! -> limit
    DEFAULT:
      TPWrite "other";
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
