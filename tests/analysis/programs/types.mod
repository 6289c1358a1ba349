MODULE types
  RECORD part
    num number;
    string label;
    pos corner;
  ENDRECORD
  ALIAS num level;
  VAR num n;
  VAR dnum d;
  VAR bool b;
  VAR string s;
  VAR pos p;
  VAR orient q;
  VAR part one:=[1,"first",[1,2,3]];
  VAR part two:=[1,2,[1,2,3]];              ! error: T301
  VAR part three:=[1,"third"];              ! error: T305
  VAR part four:=[1,"fourth",[1,2]];        ! error: T305
  VAR level height:=2;
  VAR num grid{2,3}:=[[1,2,3],[4,5,6]];
  VAR num row{3}:=[1,2];                    ! error: T305
  VAR num list{3}:=[1,TRUE,"3"];            ! error: T301, T301
  CONST pos ahead:=[0,0,2];
  CONST pos same:=+ahead;
  VAR clock watch;
  VAR clock other;
  CONST num big:=1E39;                      ! error: T324
  CONST robtarget far:=[[1E39,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]; ! error: T324

  PROC main()
    b:=1;                                   ! error: T301
    n:=d;                                   ! error: T301
    d:=n;                                   ! error: T301
    d:=3+d*2;
    d:=1+2+d;
    n:=height+1;
    height:=n;
    s:="a"+"b";
    s:="n is "+n;                           ! error: T313
    n:=n+d;                                 ! error: T313
    p:=p*2;
    p:=2*p+p;
    p:=2/p;                                 ! error: T313
    p:=p*p;
    q:=q*q;
    q:=q+q;                                 ! error: T313
    b:=n=1 AND d=1 OR NOT b;
    b:=n AND b;                             ! error: T313
    b:=s<"a";                               ! error: T313
    b:=p=[1,2,3];
    b:=[1,2,3]=p;
    b:=p=1;                                 ! error: T313
    b:=watch=other;                         ! error: T318
    b:=NOT n;                               ! error: T313
    n:=-p.x;
    p:=-p;
    s:=-s;                                  ! error: T313
    watch:=other;                           ! error: T318
    one:=[n,s,p];
    one:=[n,s];                             ! error: T305
    one:=[n,n,p];                           ! error: T301
    grid{1,2}:=n;
    grid{3,1}:=n;                           ! warning: T306
    grid{n,n}:=list{1+1};
    grid{1}:=n;                             ! error: T314
    n{1}:=1;                                ! error: T314
    list{b}:=1;                             ! error: T301
    list{TRUE AND 5}:=1;                    ! error: T301, T313
    list{same.z+2}:=1;                      ! warning: T306
    list:=row;
    list:=grid;                             ! error: T301
    list:=[1,n,3];
    list:=[1,n];                            ! error: T305
    big:=1;                                 ! error: T304
    tool0.tload.mass:=n;
    v100.v_tcp:=n;                          ! error: T304
    s:=ValToStr([1,2,3]);                   ! error: T316
    s:=ValToStr(one);
    s:=ValToStr(watch);                     ! error: T318
    IF n n:=1;                              ! error: T301
    WHILE s DO                              ! error: T301
      s:="";
    ENDWHILE
    FOR i FROM b TO 3 DO                    ! error: T301
      i:=i+1;                               ! error: T304
    ENDFOR
    TEST s
    CASE "a","b":
      n:=1;
    CASE 1:                                 ! error: T301
      n:=2;
    ENDTEST
    TEST watch                              ! error: T318
    CASE 1:
      n:=1;
    ENDTEST
    n:=half(n);
    n:=half(d);                             ! error: T301
    n:=half(2);
  ENDPROC

  FUNC num half(num of)
    IF of<0 RETURN "none";                  ! error: T301
    RETURN of/2;
  ENDFUNC
ENDMODULE
