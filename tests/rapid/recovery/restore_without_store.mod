! RAPID Instructions, RestoPath: without a path that is kept it is an error.
MODULE restore_without_store
  PROC main()
    RestoPath;
    TPWrite "level "\Num:=PathLevel();  ! -> level 1
  ERROR
    TPWrite "path "\Bool:=ERRNO=ERR_PATH;        ! -> path TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
