MODULE lenient
  VAR num n;
  VAR num m=3;                          ! error: E140
  RECORD pallet
    num heights{4};                     ! error: E147
  ENDRECORD

  PROC main                             ! error: E143
    VAR num early;
    n=1;                                ! error: E140
    VAR num late;                       ! error: E104
    two(1,2);                           ! error: E141
    two (1),(2);
    IF n=1 THEN
      VAR num nested;                   ! error: E104
    ELSEIF n=2                          ! error: E142
      n:=1;
    ENDIF
    WHILE n<3                           ! error: E142
      Incr n;
    ENDWHILE
    TEST n
    CASE 1 TO 5:                        ! error: E144
      n:=1;
    ENDTEST
    n:=%"two"%();                       ! error: E145
    n:=n*-2;                            ! note: E146
    IF n=1 AND NOT m=2 n:=1;
    <SMT>                               ! warning: E148
    n:=<EXP>;                           ! warning: E148
  ENDPROC

  PROC two(num a,num b)
  ENDPROC
ENDMODULE
