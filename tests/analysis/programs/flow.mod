MODULE flow
  VAR intnum part_seen;
  VAR num n;
  VAR errnum ERR_MINE:=-1;

  FUNC num whole(num x)
    TEST x
    CASE 1:
      RETURN 1;
    DEFAULT:
      RAISE 5;
    ENDTEST
  ENDFUNC

  FUNC num partial(num x)
    WHILE x>0 DO
      RETURN 1;
    ENDWHILE
  ENDFUNC                               ! warning: F404

  FUNC bool endless()
    WHILE TRUE DO
      IF n=1 RETURN TRUE;
    ENDWHILE
  ENDFUNC

  FUNC num jumping()
    again:
    IF n>3 RETURN n;
    n:=n+1;
    GOTO again;
  ENDFUNC

  FUNC num without()
    RETURN;                             ! error: F415
  ENDFUNC

  PROC main()
    IDelete part_seen;
    CONNECT part_seen WITH count;
    CONNECT part_seen WITH missing;     ! error: N201
    CONNECT n WITH count;
    CONNECT ERR_MINE WITH partial;      ! error: F416
    RETURN n;                           ! error: F415
    RETRY;                              ! error: F406
    TRYNEXT;                            ! error: F406
    RAISE;                              ! error: F406
    RAISE ERR_MINE;
    GOTO nowhere;                       ! error: F405
    GOTO inside;                        ! error: F405 ! warning: F401
    IF n=1 THEN
      inside:
      GOTO outside;
    ENDIF
    outside:
    outside:                            ! error: N202
    n:                                  
    count;                              ! error: N211
  ERROR
    IF ERRNO=ERR_MINE THEN
      RETRY;
    ELSEIF ERRNO=ERR_DIVZERO THEN
      TRYNEXT;
    ENDIF
    GOTO outside;                       ! error: F405
    RAISE;                              ! warning: F401
  ENDPROC

  PROC long_jump()
    main;
  ERROR (ERR_MINE,ERR_DIVZERO,ERR_MIEN) ! error: N201
    RETURN;
  UNDO
    n:=0;
  ENDPROC

  TRAP count
    n:=INTNO;
    RETURN 1;                           ! error: F415
  ENDTRAP
ENDMODULE
