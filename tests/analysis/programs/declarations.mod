MODULE declarations
  CONST num size:=3;
  CONST num twice:=size*2;
  CONST num first:=second+1;            ! error: T322
  CONST num second:=first-1;
  CONST num empty;                      ! error: T321
  CONST speeddata slow:=v100;
  CONST pos corner:=[size,twice,-1];
  VAR num list{size};
  VAR num sums{twice+1}:=[1,2,3,4,5,6,7];
  VAR num none{0};                      ! error: T317
  VAR num half{2.5};                    ! error: T317
  VAR num varying{list};                ! error: T317
  VAR num many{1,2,3,4};                ! error: T317
  VAR num start:=list{1};               ! error: T311
  VAR robtarget p:=CRobT();             ! error: T311
  PERS num kept:=-5;
  PERS num computed:=2*3;               ! error: T311
  PERS speeddata copied:=v100;          ! error: T311
  PERS pos place:=[1,2,size];           ! error: T311
  PERS num unset;
  VAR clock watch:=0;                   ! error: T318
  VAR signaldi diPart:=1;               ! error: T318
  VAR switch flag;                      ! error: T320
  ALIAS num level;
  ALIAS level height;                   ! error: T319
  RECORD loop                           ! error: T322
    loop next;
  ENDRECORD
  RECORD pair
    num a;
    num A;                              ! error: N202
  ENDRECORD

  PROC main(switch fast,clock running)  ! error: T320, T320
    VAR num room{size}:=[1,2,3];
    CONST num inner:=2;
    VAR num more{inner};
    room{1}:=more{inner};
    more:=room;                         ! error: T301
  ENDPROC

  FUNC clock watch_of()                 ! error: T320
    RETURN watch;
  ENDFUNC
ENDMODULE
